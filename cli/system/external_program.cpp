#include "cli/system/external_program.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr std::size_t most_errors = 4096;  // bytes of stderr
constexpr int patience = 100;              // ms

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw UsageError(fmt::format("no other program can be started: {}", std::strerror(errno)));
  }
  ~Pipe() {
    ::close(ends_[0]);
    close_entry();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int exit() const { return ends_[0]; }
  int entry() const { return ends_[1]; }
  void close_entry() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{};
};

/// Searches only absolute folders of PATH: the current folder may be foreign.
fs::path found_in_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / name;
    std::error_code error;
    if (folder.starts_with('/') && fs::is_regular_file(program, error) &&
        ::access(program.c_str(), X_OK) == 0)
      return program;
  }
  return {};
}

/// Returns 0 or an errno.
int spawn(const std::vector<std::string>& arguments, const fs::path& folder, int errors, pid_t& process) {
  std::vector<char*> raw;
  for (const std::string& argument : arguments) raw.push_back(const_cast<char*>(argument.c_str()));
  raw.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  const int error = ::posix_spawn(&process, raw[0], &actions, nullptr, raw.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

void follow(pid_t process, int errors, const Interrupts& interrupts, ProcessResult& result,
            std::optional<std::chrono::seconds> limit) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::array<char, 1024> buffer{};
  while (true) {
    if (interrupts.interrupted() && !result.stopped) {
      result.stopped = true;
      ::kill(process, SIGTERM);
    }
    if (limit && !result.late && Clock::now() - start > *limit) {
      result.late = true;
      ::kill(process, SIGKILL);
    }
    pollfd ready{errors, POLLIN, 0};
    if (::poll(&ready, 1, patience) <= 0) continue;
    const ssize_t count = ::read(errors, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    result.errors.append(buffer.data(), static_cast<std::size_t>(count));
    if (result.errors.size() > most_errors) result.errors.erase(0, result.errors.size() - most_errors);
  }
}

/// A new folder, without foreign links. Requires the FileLock of `file`.
class Workplace {
 public:
  explicit Workplace(const fs::path& file)
      : folder_(file.string() + ".part"), file_(folder_ / file.filename()) {
    remove();  // left by a killed process
    if (::mkdir(folder_.c_str(), 0700) != 0)
      throw OutputError(folder_.string(),
                        fmt::format("the folder cannot be created: {}", std::strerror(errno)));
  }
  ~Workplace() { remove(); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const fs::path& file() const { return file_; }

 private:
  /// Follows no link.
  void remove() const {
    struct stat found {};
    if (::lstat(folder_.c_str(), &found) != 0) return;
    if (!S_ISDIR(found.st_mode)) {
      ::unlink(folder_.c_str());
      return;
    }
    ::unlink(file_.c_str());
    ::rmdir(folder_.c_str());
  }

  fs::path folder_, file_;
};

std::string last_lines(const std::string& text) {
  constexpr int shown = 5;
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) lines.push_back("  " + line);
  if (lines.size() > shown) lines.erase(lines.begin(), lines.end() - shown);
  return join(lines, "\n");
}

}  // namespace

ProcessResult run_process(std::vector<std::string> arguments, const fs::path& folder,
                          const Interrupts& interrupts, std::optional<std::chrono::seconds> limit) {
  ProcessResult result;
  const fs::path program = found_in_path(arguments.front());
  result.found = !program.empty();
  if (!result.found) return result;
  arguments.front() = program.string();
  Pipe pipe;
  pid_t process = 0;
  const int error = spawn(arguments, folder, pipe.entry(), process);
  if (error != 0)
    throw UsageError(fmt::format("{} cannot be started: {}", arguments[0], std::strerror(error)));
  pipe.close_entry();
  follow(process, pipe.exit(), interrupts, result, limit);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

int make_file(const Maker& maker, const MakerArguments& arguments, const fs::path& folder,
              const fs::path& file) {
  const Interrupts interrupts;
  const FileLock turn(file);
  const Workplace workplace(fs::absolute(file));
  const fs::path& part = workplace.file();
  std::vector<std::string> words = arguments(part);
  words.insert(words.begin(), maker.name);
  const ProcessResult result = run_process(words, folder, interrupts);
  std::error_code error;
  const bool good = result.found && !result.stopped && result.code == 0;
  if (good) fs::rename(part, file, error);
  if (good && !error) return exit_fine;
  if (!result.found)
    throw OutputError(file.string(),
                      fmt::format("{} is needed for {} and is not installed (apt-get install {})", maker.name,
                                  maker.purpose, maker.package));
  if (result.stopped) return Interrupts::exit_code();
  throw OutputError(file.string(), error ? "cannot be written: " + error.message()
                                         : fmt::format("{} failed with exit code {}\n{}", maker.name,
                                                       result.code, last_lines(result.errors)));
}

}  // namespace taut::cli
