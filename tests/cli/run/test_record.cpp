#include <doctest/doctest.h>

#include "cli/run/record.hpp"
#include "engine/error.hpp"

using namespace taut;
using namespace taut::cli;

namespace {

RunRecord full_record() {
  RunRecord record;
  record.scene = "rod", record.method = "oenog", record.material_law = "3d_deviator";
  record.remark = "odd", record.contact = "surface", record.stepping = "dual", record.cfl = 0.1 / 3;
  record.parameters = {{"v0", 0.06}, {"a", -1e-300}};
  record.dim = 3, record.spacing = 0.1 + 0.2, record.requested_spacing = 0.3;
  record.jitter.share = 0.05, record.jitter.seed = 7;
  record.file_checksum = "0123456789abcdef";
  record.saved_particles = {.format = "vtp", .precision = "single", .fields = {"speed", "pressure"}};
  record.particles = 5'000'000'000, record.mass = 1.5, record.until = 2, record.reached = 1;
  record.status = RunRecord::Status::failed, record.reason = "because";
  record.steps = 12, record.threads = 3, record.machine = "abacus";
  record.seconds = {.setup = 1, .solve = 2, .render = 3, .write = 4, .cpu = 5};
  record.verdict = Verdict::fractured;
  record.since = {{Verdict::hourglass, 0.25}, {Verdict::fractured, 0.5}};
  record.beyond_law = {.share = 0.1, .since = 0.2};
  record.energy_gain = {.greatest = 1.2, .since = 0.3};
  record.turn = {.greatest = 0.02, .since = 0.4};
  record.pieces = 2;
  record.indicator[0] = {.greatest_part = 3, .greatest_whole = 10, .at = 0.1, .particle = 4, .last = 0.2};
  record.patch_body = "left", record.patch_place = {1, 2, 3};
  record.conservation = {.linear_momentum = 0.1,
                         .angular_momentum = {},
                         .energy = 0.2,
                         .energy_gained = 0.01,
                         .energy_lost = 0.2};
  record.measures = {{"period", "period", "s", 2, 1.9, "exact", 0.05, ""},
                     {"rise", "peak", "m", {}, {}, "", {}, "short"}};
  return record;
}

std::string text_without_provenance(Json json) {
  json["provenance"] = nullptr;
  return json.dump(2);
}

RunRecord read(const Json& json) { return record_from(JsonCursor(json, "run.json")); }

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a record reads back as it was written") {
    for (const RunRecord& record : {full_record(), RunRecord{}}) {
      const RunRecord again = read(to_json(record));
      CHECK(text_without_provenance(to_json(again)) == text_without_provenance(to_json(record)));
      CHECK(to_results(again).dump(2) == to_results(record).dump(2));
    }
    CHECK(to_json(full_record()).members().size() + 1 == record_fields().size());  // all but other_load
  }

  TEST_CASE("numbers that are not finite are written as null") {
    RunRecord record = full_record();
    record.mass = NAN, record.since[Verdict::fractured] = INFINITY, record.conservation.energy = -INFINITY;
    record.indicator[1].greatest_part = NAN;
    record.measures[0].error = NAN;
    const Json json = parse_json(to_json(record).dump(), "run.json");
    CHECK(json.find("mass")->is_null());
    CHECK(text_without_provenance(to_json(read(json))) == text_without_provenance(json));
  }

  TEST_CASE("each key of run.json that has a wrong type is refused with its name") {
    const Json good = to_json(full_record());
    for (const RecordField& field : record_fields()) {
      if (!good.find(field.key)) continue;
      Json bad = good;
      bad[field.key] = Json::array();
      bad[field.key].add(true);
      CAPTURE(field.key);
      try {
        read(bad);
        FAIL("a wrong type was accepted");
      } catch (const UsageError& error) {
        CHECK(std::string(error.what()).starts_with("'run.json': key '" + std::string(field.key)));
      }
    }
  }

  TEST_CASE("the checksum of files and the form of saved particles are in run.json only if known") {
    const RunRecord again = read(to_json(full_record()));
    CHECK(again.file_checksum == "0123456789abcdef");
    CHECK(again.saved_particles == full_record().saved_particles);
    for (const char* key : {"file_checksum", "saved_particles"}) {
      CHECK_FALSE(to_json(RunRecord{}).find(key));
      CHECK_FALSE(to_results(full_record()).find(key));
    }
  }

  TEST_CASE("the load by other programs is read from provenance and is written into results only") {
    const Json json = {{"taut", "0.2.0"}, {"provenance", {{"other_load", 1.5}}}};
    const RunRecord record = read(json);
    CHECK(record.other_load == 1.5);
    CHECK(to_results(record).find("other_load")->number() == 1.5);
    CHECK_FALSE(to_json(record).find("other_load"));
    CHECK_FALSE(to_results(record).find("provenance"));
  }
}
