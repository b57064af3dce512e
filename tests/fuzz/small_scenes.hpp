#pragma once

#include <array>
#include <string_view>

#include "engine/scene/scene.hpp"

namespace taut::fuzz {

/// Small enough to fuzz.
bool is_small(const Scene& scene);

struct SmallScene {
  std::string_view method, text;
};

inline constexpr std::string_view disc_and_square = R"(title = "Disc and square"
method = "enog"
spacing = 0.25
until = 0.2
damping = 1
[parameters]
speed = { value = 1, unit = "m/s", help = "of the disc", min = 0, max = 5 }
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

inline constexpr std::string_view block_and_ball = R"(title = "Block and ball"
dim = 3
spacing = 0.34
until = 0.2
[parameters]
speed = { value = 1, unit = "m/s", help = "of the ball" }
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

/// For each family except finite elements.
inline constexpr std::array small_scenes = {
    SmallScene{"enog", disc_and_square},          SmallScene{"oenog", disc_and_square},
    SmallScene{"d-ulsph-r-tic", disc_and_square}, SmallScene{"tl", disc_and_square},
    SmallScene{"pfhj-jst", disc_and_square},      SmallScene{"oenog", block_and_ball},
    SmallScene{"pfj-jst", block_and_ball},        SmallScene{"enog", block_and_ball},
};

}  // namespace taut::fuzz
