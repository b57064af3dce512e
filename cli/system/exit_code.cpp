#include "cli/system/exit_code.hpp"

#include <exception>
#include <new>
#include <ostream>
#include <string>

#include "engine/error.hpp"

namespace taut::cli {

namespace {

/// "file:line:column: message", as compilers have it, with what is known.
std::string with_place(const SceneError& e) {
  std::string place = e.file;
  if (e.line > 0) place += ":" + std::to_string(e.line);
  if (e.line > 0 && e.column > 0) place += ":" + std::to_string(e.column);
  if (place.empty()) place = e.key;
  return place.empty() ? e.what() : place + ": " + e.what();
}

}  // namespace

int guarded(const std::function<int()>& action, std::ostream& err) {
  const auto fail = [&err](const std::string& message, int code) {
    err << "taut: " << message << '\n';
    return code;
  };
  try {
    return action();
  } catch (const SceneError& e) {
    err << with_place(e) << '\n';
    return exit_wrong_input;
  } catch (const UsageError& e) {
    return fail(e.what(), exit_wrong_input);
  } catch (const NumericalError& e) {
    return fail(e.what(), exit_diverged);
  } catch (const OutputError& e) {
    return fail(e.path + ": " + e.what(), exit_not_written);
  } catch (const std::bad_alloc&) {
    return fail("out of memory: take a larger --spacing, a smaller --size, fewer --frames or a fixed --range",
                exit_wrong_input);
  } catch (const std::exception& e) {
    return fail(std::string(e.what()) + " (this is a bug of taut)", exit_bug);
  }
}

}  // namespace taut::cli
