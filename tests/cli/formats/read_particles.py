"""Prints what VTK reads from a .vtp file, or ASE from an .xyz file."""
import sys


def show(name, values):
    print(name, *(repr(float(value)) for value in values))


def read_vtp(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    arrays = data.GetPointData()
    show("vertices", [data.GetNumberOfVerts()])
    show("last_vertex", [data.GetCell(data.GetNumberOfCells() - 1).GetPointId(0)])
    show("time", [data.GetFieldData().GetArray("TimeValue").GetValue(0)])
    show("positions", vtk_to_numpy(data.GetPoints().GetData()).flatten())
    for k in range(arrays.GetNumberOfArrays()):
        array = arrays.GetArray(k)
        show(array.GetName(), vtk_to_numpy(array).flatten())
        print(array.GetName() + ".type", array.GetDataTypeAsString())
        if array.HasAComponentName():
            names = [array.GetComponentName(c) for c in range(array.GetNumberOfComponents())]
            print(array.GetName() + ".components", *names)
    print("vectors", arrays.GetVectors().GetName())
    print("tensors", arrays.GetTensors().GetName() if arrays.GetTensors() else "none")


def read_xyz(path):
    import ase.io

    atoms = ase.io.read(path, format="extxyz")
    show("time", [atoms.info["Time"]])
    show("origin", atoms.info["Origin"])
    show("cell", atoms.cell.array.flatten())
    show("periodic", atoms.pbc)
    for name, values in atoms.arrays.items():
        show(name, values.flatten())


read_vtp(sys.argv[1]) if sys.argv[1].endswith(".vtp") else read_xyz(sys.argv[1])
