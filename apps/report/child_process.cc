#include "apps/report/child_process.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scattermeter::apps {
namespace {

constexpr std::size_t kErrorsKept = 4096;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// Unnamed files are used instead of pipes, so that neither side waits for the other and a child
// that ends early causes no SIGPIPE.
File nameless_file() {
  File file(std::tmpfile());
  if (!file) fail("run_child: no temporary file");
  return file;
}

class FileActions {
 public:
  FileActions() {
    if (posix_spawn_file_actions_init(&actions_) != 0) fail("run_child");
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  void connect(int from, int to) {
    if (posix_spawn_file_actions_adddup2(&actions_, from, to) != 0) fail("run_child");
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

ChildResult run_child(const std::vector<std::string>& words, const std::string& input,
                      int output_descriptor) {
  const File in = nameless_file();
  const File errors = nameless_file();
  if (std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() ||
      std::fflush(in.get()) != 0 || lseek(fileno(in.get()), 0, SEEK_SET) != 0) {
    fail("run_child: the input cannot be stored");
  }
  FileActions actions;
  actions.connect(fileno(in.get()), STDIN_FILENO);
  actions.connect(output_descriptor, STDOUT_FILENO);
  actions.connect(fileno(errors.get()), STDERR_FILENO);
  std::vector<std::string> owned = words;
  std::vector<char*> argv;
  for (std::string& word : owned) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, argv[0], actions.get(), nullptr, argv.data(), environ);
  if (error != 0) return {ChildResult::kNotStarted, std::generic_category().message(error)};
  int status = 0;
  while (waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) fail("run_child: waitpid");
  }
  ChildResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.errors.resize(kErrorsKept);
  const ssize_t read = pread(fileno(errors.get()), result.errors.data(), kErrorsKept, 0);
  result.errors.resize(read > 0 ? static_cast<std::size_t>(read) : 0);
  while (!result.errors.empty() && result.errors.back() == '\n') result.errors.pop_back();
  return result;
}

}  // namespace scattermeter::apps
