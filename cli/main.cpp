#include <iostream>

#include "cli/program.hpp"

int main(int argc, char** argv) { return taut::run_program({argv + 1, argv + argc}, std::cout, std::cerr); }
