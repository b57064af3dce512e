"""Prints what VTK reads from a .vtp file: the particles, the vertices, the time, then name and sum of each array."""
import sys

import vtk

reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
print("points", data.GetNumberOfPoints())
print("vertices", data.GetNumberOfVerts())
print("last_vertex", data.GetCell(data.GetNumberOfCells() - 1).GetPointId(0))
print("time", repr(data.GetFieldData().GetArray("TimeValue").GetValue(0)))
for axis, name in enumerate("xyz"):
    print(name, repr(sum(data.GetPoint(i)[axis] for i in range(data.GetNumberOfPoints()))))
for k in range(data.GetPointData().GetNumberOfArrays()):
    array = data.GetPointData().GetArray(k)
    print(array.GetName(), repr(sum(array.GetValue(i) for i in range(array.GetNumberOfValues()))))
vectors = data.GetPointData().GetVectors()
print("vectors", repr(sum(vectors.GetValue(i) for i in range(vectors.GetNumberOfValues()))))
