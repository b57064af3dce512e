#include "cli/system/external_program.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr std::size_t most_errors = 4096;  // bytes kept of stderr
constexpr int patience = 100;              // ms between checks for interrupts

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw UsageError(std::string("no other program can be started: ") + std::strerror(errno));
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
  const int error = ::posix_spawnp(&process, raw[0], &actions, nullptr, raw.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Reads stderr to its end. An interrupt stops the program.
void follow(pid_t process, int errors, const Interrupts& interrupts, ProcessResult& result) {
  std::array<char, 1024> buffer{};
  while (true) {
    if (interrupts.asked() && !result.stopped) {
      result.stopped = true;
      ::kill(process, SIGTERM);
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

ProcessResult run_process(const std::vector<std::string>& arguments, const fs::path& folder,
                          const Interrupts& interrupts) {
  ProcessResult result;
  Pipe pipe;
  pid_t process = 0;
  const int error = spawn(arguments, folder, pipe.entry(), process);
  if (error == ENOENT) {
    result.found = false;
    return result;
  }
  if (error != 0) throw UsageError(arguments[0] + " cannot be started: " + std::strerror(error));
  pipe.close_entry();
  follow(process, pipe.exit(), interrupts, result);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

fs::path unfinished(const fs::path& file) {
  fs::path part = file;
  return part.replace_extension(".part" + file.extension().string());
}

int make_file(const Maker& maker, const std::vector<std::string>& arguments, const fs::path& folder,
              const fs::path& file) {
  const fs::path part = unfinished(file);
  std::vector<std::string> words{maker.name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Interrupts interrupts;
  const WriteTurn turn(file);
  const ProcessResult result = run_process(words, folder, interrupts);
  std::error_code error;
  const bool good = result.found && !result.stopped && result.code == 0;
  if (good) fs::rename(part, file, error);
  if (good && !error) return exit_fine;
  std::error_code ignored;
  fs::remove(part, ignored);
  if (!result.found)
    throw OutputError(file.string(), maker.name + " is needed for " + maker.purpose +
                                         " and is not installed (apt-get install " + maker.package + ")");
  if (result.stopped) return Interrupts::exit_code();
  throw OutputError(file.string(), error
                                       ? "cannot be written: " + error.message()
                                       : maker.name + " failed with exit code " +
                                             std::to_string(result.code) + "\n" + last_lines(result.errors));
}

}  // namespace taut::cli
