#pragma once

#include <array>
#include <string_view>

#include "engine/scene/scene.hpp"

namespace taut::fuzz {

/// Larger scenes are valid, but too slow to fuzz.
bool is_small(const Scene& scene);

struct SmallScene {
  std::string_view method, text;
};

inline constexpr std::string_view two_discs = R"(title = "Two discs"
method = "enog"
spacing = 0.25
until = 0.2
damping = 1
[parameters]
speed = { value = 1, unit = "m/s", help = "of each", min = 0, max = 5 }
[material.rubber]
density = 1
youngs_modulus = 100
poisson_ratio = 0.4
[[body]]
name = "left"
shape = { type = "disc", centre = [-0.55, 0], radius = 0.5 }
material = "rubber"
velocity = ["speed", 0]
[[body]]
name = "right"
shape = { type = "rectangle", low = [0, -0.5], high = [1, 0.5] }
material = "rubber"
held = "x > 0.8"
[[wall]]
name = "floor"
at = [0, -0.55]
normal = [0, 1]
[[probe]]
name = "gap"
of = "gap"
bodies = ["left", "right"]
[[measure]]
name = "least"
of = "minimum"
probe = "gap"
unit = "m"
[render]
color = "speed"
frames = 3
size = [64, 64]
)";

inline constexpr std::string_view two_blocks = R"(title = "Two blocks"
dim = 3
spacing = 0.34
until = 0.2
[parameters]
speed = { value = 1, unit = "m/s", help = "of the upper one" }
[material.rubber]
density = 1
youngs_modulus = 100
poisson_ratio = 0.4
[[body]]
name = "lower"
shape = { type = "box", low = [0, 0, 0], high = [1, 1, 0.7] }
material = "rubber"
held = "z < 0.3"
[[body]]
name = "upper"
shape = { type = "ball", centre = [0.5, 0.5, 1.25], radius = 0.5 }
material = "rubber"
velocity = [0, 0, "-speed"]
[render]
frames = 2
size = [64, 64]
)";

/// Scenes for each family except finite elements; some are in 3D.
inline constexpr std::array small_scenes = {
    SmallScene{"enog", two_discs},          SmallScene{"oenog", two_discs},
    SmallScene{"d-ulsph-r-tic", two_discs}, SmallScene{"tl", two_discs},
    SmallScene{"pfhj-jst", two_discs},      SmallScene{"oenog", two_blocks},
    SmallScene{"pfj-jst", two_blocks},      SmallScene{"enog", two_blocks},
};

}  // namespace taut::fuzz
