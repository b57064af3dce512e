#include "cli/system/exit_code.hpp"

#include <exception>
#include <filesystem>
#include <new>
#include <ostream>
#include <string>

#include <fmt/core.h>

#include "cli/text/shown.hpp"
#include "engine/error.hpp"

namespace taut::cli {

namespace {

/// "file:line:column: message"
std::string with_place(const SceneError& e) {
  std::string place = e.file;
  if (e.line > 0) place += ":" + std::to_string(e.line);
  if (e.line > 0 && e.column > 0) place += ":" + std::to_string(e.column);
  if (place.empty()) place = e.key;
  return place.empty() ? e.what() : fmt::format("{}: {}", place, e.what());
}

Failure raw_failure() {
  try {
    throw;
  } catch (const SceneError& e) {
    return {with_place(e), exit_wrong_input};
  } catch (const UsageError& e) {
    return {e.what(), exit_wrong_input};
  } catch (const NumericalError& e) {
    return {e.what(), exit_diverged};
  } catch (const OutputError& e) {
    return {fmt::format("{}: {}", e.path, e.what()), exit_not_written};
  } catch (const std::bad_alloc&) {
    return {"out of memory: use a larger --spacing, a smaller --size, fewer --frames or a fixed --range",
            exit_wrong_input};
  } catch (const std::filesystem::filesystem_error& e) {
    const std::string path = e.path1().empty() ? "the current folder" : e.path1().string();
    return {fmt::format("{}: {}", path, e.code().message()), exit_not_written};
  } catch (const std::exception& e) {
    return {std::string(e.what()) + " (this is a bug of taut)", exit_bug};
  } catch (...) {
    return {"an error without a message (this is a bug of taut)", exit_bug};
  }
}

}  // namespace

/// Control sequences of foreign files must not reach the terminal.
Failure current_failure() {
  Failure failure = raw_failure();
  failure.message = printable(failure.message);
  return failure;
}

int guarded(const std::function<int()>& action, std::ostream& err) {
  try {
    return action();
  } catch (const SceneError&) {
    err << current_failure().message << '\n';
    return exit_wrong_input;
  } catch (...) {
    const Failure failure = current_failure();
    err << "taut: " << failure.message << '\n';
    return failure.code;
  }
}

}  // namespace taut::cli
