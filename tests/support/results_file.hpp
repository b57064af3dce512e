#pragma once

#include <string>

#include "tests/support/program_runner.hpp"

namespace taut::test {

/// Lines of `rows`: "status,set.method,method,spacing,steps,verdict,since.fractured,error,reference,seconds,EXTRA".
inline std::string write_results(const fs::path& folder, const std::string& rows,
                                 const std::string& scene = "rod", const std::string& extra_column = "none") {
  fs::create_directories(folder);
  std::ofstream file(folder / "results.csv");
  file << "status,set.method,method,spacing,steps,verdict,since.fractured,measures.bend.error,"
          "measures.bend.reference,seconds.solve,set."
       << extra_column
       << ",scene,dim,particles,folder,measures.bend.unit,measures.bend.reference_name,measures.twist.unit,"
          "threads,machine\n";
  std::istringstream lines(rows);
  for (std::string line; std::getline(lines, line);)
    file << line << ',' << scene << ",2,100,here,mm,exact,1,1,\"abacus, \"\"fast\"\"\"\n";
  return (folder / "results.csv").string();
}

}  // namespace taut::test
