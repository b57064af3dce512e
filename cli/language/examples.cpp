#include <algorithm>

#include "cli/language/reference.hpp"

namespace taut::cli {
namespace {

struct Example {
  std::string_view name, text;
};

/// Examples of top-level keys and sections with a [header] together form a valid scene, sweep, claim file and suite.
constexpr Example examples[] = {
    {"scene", R"toml(title = "A disc hits a bar"
dim = 2
spacing = 0.002                         # m
until = 0.02                            # s
method = "oenog"
gravity = [0, -9.81]                    # m/s²
)toml"},
    {"parameters", R"toml([parameters]                            # each can be changed with --set speed=8
speed = { value = 5, unit = "m/s", min = 0, max = 20, help = "downward speed of the disc" }
high = { value = "0.01 + 2*dp", unit = "m", help = "height of the disc's centre above the bar" }
)toml"},
    {"material", R"toml([material.rubber]
density = 1200
youngs_modulus = 1e7
poisson_ratio = 0.4

[material.stiff]
density = 1200
youngs_modulus = 5e7
poisson_ratio = 0.4
)toml"},
    {"body", R"toml([[body]]
name = "bar"
shape = { type = "rectangle", low = [-0.05, -0.01], high = [0.05, 0] }
material = "rubber"
held = "abs(x) > 0.05 - 4*dp"           # the ends are clamped
parts = [{ material = "stiff", where = "x > 0.02" }]

[[body]]
name = "disc"
shape = { type = "disc", centre = [0, "high"], radius = 0.01 }
material = "rubber"
velocity = [0, "-speed"]
)toml"},
    {"shape", R"toml(shape = [{ type = "rectangle", low = [-0.05, -0.01], high = [0.05, 0] },
         { type = "disc", centre = [0.05, -0.005], radius = 0.005 }]
)toml"},
    {"rotate", R"toml(rotate = { angle = 5, about = [0, 0] }
)toml"},
    {"parts", R"toml(parts = [{ material = "stiff", where = "x > 0.02" }]
)toml"},
    {"driven",
     R"toml(driven = [{ where = "x > 0.05 - 4*dp", velocity = [0, "0.5*sin(2*pi*t/0.01)"], until = 0.01 }]
)toml"},
    {"loaded",
     R"toml(loaded = [{ where = "abs(x) < 0.01", force = [0, -100], ramp = "t < 0.01 ? t/0.01 : 1" }]
)toml"},
    {"wall", R"toml([[wall]]
name = "floor"
at = [0, -0.05]
normal = [0, 1]
)toml"},
    {"probe", R"toml([[probe]]
name = "middle"
of = "displacement"
body = "bar"
at = [0, 0]
component = "y"

[[probe]]
name = "gap"
of = "gap"
bodies = ["bar", "disc"]
)toml"},
    {"line", R"toml([[line]]
name = "across"
body = "bar"
field = "von_mises"
from = [0, -0.01]
to = [0, 0]
points = 11
times = [0.01, 0.02]
)toml"},
    {"measure", R"toml([[measure]]
name = "deflection"
of = "minimum"
probe = "middle"
unit = "m"

[[measure]]
name = "touch_time"
of = "first_below"
probe = "gap"
threshold = "touching"                  # the gap below which bodies count as touching
unit = "s"

[[measure]]
name = "curve_rmse"
of = "rmse"
probe = "middle"
unit = "m"
)toml"},
    {"reference", R"toml([[reference]]
law = "neo-hookean"
name = "made-up numbers"
values = { deflection = -0.004, touch_time = 8e-4 }

[[reference]]
law = "2d-deviator"
name = "made-up formula"
let = { a = 0.004, T = 0.01 }
solutions = { curve_rmse = "-a*sin(pi*t/T)" }
)toml"},
    {"tables",
     R"toml(tables = { curve_rmse = { file = "references/oscillating_plate_neo_hookean_vf0.05.csv", column = "tip_uy" } }
)toml"},
    {"render", R"toml([render]
color = "von_mises"
range = [0, 2e6]
view = [-0.06, 0.06, -0.03, 0.05]
frames = 40
)toml"},
    {"sweep", R"toml(title = "How fast may the rings be?"
scene = "colliding-rings"
)toml"},
    {"set", R"toml(set = { until = 0.01 }
)toml"},
    {"grid", R"toml([grid]
v0 = "0.02:0.16:0.02"                   # from, to and step
method = ["og", "oenog"]
)toml"},
    {"row", R"toml([[row]]
v0 = 0.02
method = "oenog"
"method.damping" = 0

[[row]]
v0 = 0.04
method = "tl"
)toml"},
    {"chart", R"toml([chart]
measure = ["least_diameter", "rebound_ratio"]
cost = "cpu"
)toml"},
    {"map", R"toml([map]
parameter = "v0"
)toml"},
    {"history", R"toml([history]
gap = "gap, m"
)toml"},
    {"claims", R"toml(title = "J. J. Monaghan: SPH without a tensile instability"
)toml"},
    {"claim", R"toml([[claim]]
key = "fig-6"
place = "Fig. 6"
text = "With the original method the rings tear, with artificial stress they do not."
scene = "colliding-rings"
set = { until = 0.005 }                 # of every run
run.og = { method = "og" }
run.oas = { method = "oas", "method.epsilon" = 0.3 }
criterion = "og.verdict >= fractured && oas.verdict < fractured && og.since.fractured < 0.005"
last_run = "never"
)toml"},
    {"suite", R"toml(title = "Pictures of the rings"
set = { spacing = 0.002, until = 0.006 }
render = { frames = 3, size = [320, 180] }
fail = 20                               # ΔE*ab
)toml"},
    {"entry", R"toml([[entry]]
name = "rings"
scene = "colliding-rings"
warn = 5                                # ΔE*ab

[[entry]]
name = "rings-tl"
scene = "colliding-rings"
method = "tl"
render = { color = "pressure" }

[[entry]]
name = "faster-rings"                   # a control: shows that the suite can fail
differs_from = "rings"
set = { v0 = 0.07 }
)toml"},
    {"rectangle", "shape = { type = \"rectangle\", low = [-0.05, -0.01], high = [0.05, 0] }\n"},
    {"disc", "shape = { type = \"disc\", centre = [0, 0.02], radius = 0.01 }\n"},
    {"ring", "shape = { type = \"ring\", centre = [0, 0], inner = 0.03, outer = 0.04 }\n"},
    {"ellipse", "shape = { type = \"ellipse\", centre = [0, 0], semi_axes = [0.03, 0.01], rotate = 30 }\n"},
    {"polygon", "shape = { type = \"polygon\", points = [[0, 0], [0.04, 0], [0.02, 0.03]] }\n"},
    {"mesh", "shape = { type = \"mesh\", file = \"pawn.stl\", scale = 0.001, centre = [0, 0, 0.02] }\n"},
    {"svg", "shape = { type = \"svg\", file = \"letter.svg\", height = 0.06, centre = [0, 0] }\n"},
    {"mask", "shape = { type = \"mask\", file = \"picture.png\", width = 0.1, low = [0, 0] }\n"},
    {"expression",
     R"toml(shape = { type = "expression", inside = "x^2 + y^2 < 0.02^2", low = [-0.02, -0.02], high = [0.02, 0.02] }
)toml"},
    {"particles", "shape = { type = \"particles\", file = \"places.csv\" }\n"},
    {"union", R"toml(shape = { type = "union", shapes = [
    { type = "rectangle", low = [-0.02, 0], high = [0.02, 0.02] },
    { type = "disc", centre = [0, 0.02], radius = 0.01 }] }
)toml"},
    {"intersection", R"toml(shape = { type = "intersection", shapes = [
    { type = "rectangle", low = [-0.02, 0], high = [0.02, 0.02] },
    { type = "disc", centre = [0, 0], radius = 0.02 }] }
)toml"},
    {"difference", R"toml(shape = { type = "difference", shapes = [
    { type = "rectangle", low = [-0.02, 0], high = [0.02, 0.02] },
    { type = "disc", centre = [0, 0.02], radius = 0.01 }] }
)toml"},
    {"ellipsoid", "shape = { type = \"ellipsoid\", centre = [0, 0, 0], semi_axes = [0.03, 0.01, 0.02] }\n"},
    {"box", "shape = { type = \"box\", low = [0, 0, 0], high = [0.1, 0.02, 0.02] }\n"},
    {"ball", "shape = { type = \"ball\", centre = [0, 0, 0], radius = 0.02 }\n"},
    {"shell", "shape = { type = \"shell\", centre = [0, 0, 0], inner = 0.03, outer = 0.04 }\n"},
    {"cylinder",
     "shape = { type = \"cylinder\", from = [0, 0, 0], to = [0.1, 0, 0], radius = 0.02, inner = 0.01 }\n"},
};

}  // namespace

std::string_view example_of(std::string_view name) {
  const auto* found = std::ranges::find(examples, name, &Example::name);
  return found == std::end(examples) ? std::string_view() : found->text;
}

}  // namespace taut::cli
