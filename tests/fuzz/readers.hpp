#pragma once

#include <string_view>

namespace taut::fuzz {

// scene_readers.cpp
void read_toml(std::string_view bytes);
void read_scene_file(std::string_view bytes);
void read_sweep_file(std::string_view bytes);
void read_expression(std::string_view bytes);
void read_outline(std::string_view bytes);
void read_svg_file(std::string_view bytes);

// typed_readers.cpp
void read_session_lines(std::string_view bytes);
void read_arguments(std::string_view bytes);
void read_completion(std::string_view bytes);
void read_values(std::string_view bytes);
void read_text(std::string_view bytes);

// output_readers.cpp
void read_particle_file(std::string_view bytes);
void read_picture(std::string_view bytes);
void read_results_files(std::string_view bytes);
void read_records(std::string_view bytes);
void read_tables(std::string_view bytes);

// state_readers.cpp
void read_checkpoint_file(std::string_view bytes);
void read_state(std::string_view bytes);
void read_resumed(std::string_view bytes);

}  // namespace taut::fuzz
