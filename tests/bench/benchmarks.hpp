#pragma once

namespace taut::bench {

void register_methods();
void register_program();

}  // namespace taut::bench
