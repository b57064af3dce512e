#pragma once

// Every law; Law in methods/formulation.hpp names them.
#include "engine/materials/linear_elastic.hpp"
#include "engine/materials/neo_hookean.hpp"
#include "engine/materials/rotated_piola.hpp"
#include "engine/materials/st_venant_kirchhoff.hpp"
