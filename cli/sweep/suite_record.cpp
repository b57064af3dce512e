#include "cli/sweep/suite_record.hpp"

#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"
#include "cli/text/json_cursor.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

fs::path file_in(const fs::path& folder) { return folder / "suite.json"; }

Json to_json(const SuiteRecord::Entry& entry) {
  return {{"name", entry.name},
          {"baseline", entry.baseline.string()},
          {"differs_from", entry.differs_from},
          {"warn", entry.warn},
          {"fail", entry.fail},
          {"problem", entry.problem}};
}

}  // namespace

void write_suite_record(const fs::path& folder, const SuiteRecord& record) {
  Json json{{"taut", build_info.version},
            {"format", format_of("suite.json")},
            {"title", record.title},
            {"file", record.file},
            {"entries", Json::array()}};
  for (const SuiteRecord::Entry& entry : record.entries) json["entries"].add(to_json(entry));
  make_folders(folder);
  write_atomically(file_in(folder), json.dump(2) + "\n");
}

bool has_suite_record(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(file_in(folder), error);
}

SuiteRecord read_suite_record(const fs::path& folder) {
  const std::string file = file_in(folder).string();
  const std::optional<std::string> text = read_whole(file);
  if (!text) throw UsageError("'" + file + "' cannot be read");
  const Json json = parse_json(*text, file);
  const JsonCursor root(json, file);
  root.check_object();
  SuiteRecord record{root.at("title").text(), root.at("file").text(), {}};
  for (const JsonCursor& entry : root.at("entries").items()) {
    entry.check_object();
    record.entries.push_back({entry.at("name").text(), entry.at("baseline").text(),
                              entry.at("differs_from").text(), entry.at("warn").number(),
                              entry.at("fail").number(), entry.at("problem").text()});
  }
  return record;
}

}  // namespace taut::cli
