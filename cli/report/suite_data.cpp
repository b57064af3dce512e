#include "cli/report/suite_data.hpp"

#include "cli/report/difference_data.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/sweep/suite_record.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {

Json suite_data(const fs::path& suite, const fs::path& pictures, const Links& links) {
  const SuiteRecord record = read_suite_record(suite);
  Json entries = Json::array();
  for (const SuiteRecord::Entry& entry : record.entries) {
    Json shown{{"name", entry.name}, {"differs_from", entry.differs_from}, {"problem", entry.problem}};
    if (entry.problem.empty()) try {
        const Compared compared{fs::proximate(suite / entry.baseline), suite / entry.name,
                                limit_of({entry.fail}), entry.warn};
        shown["comparison"] = difference_data(compared, pictures / entry.name, links);
      } catch (const UsageError& error) {
        shown["problem"] = error.what();
      }
    entries.add(std::move(shown));
  }
  return {{"title", record.title}, {"file", record.file}, {"entries", entries}};
}

}  // namespace taut::cli
