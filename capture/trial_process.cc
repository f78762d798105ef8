#include "capture/trial_process.h"

#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scattermeter::capture {
namespace {

constexpr int kReturned = 0;
constexpr int kThrew = 1;

// What a crash would do to the user or to this process's parent is undone: messages to the
// terminal, core files, handlers (a debugger's, a sanitizer's).
void be_quiet() {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  sigset_t none_blocked;
  sigemptyset(&none_blocked);
  sigprocmask(SIG_SETMASK, &none_blocked, nullptr);
  for (const int signal : {SIGABRT, SIGALRM, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) {
    std::signal(signal, SIG_DFL);
  }
}

// No handler or destructor of the copied process is run.
[[noreturn]] void try_and_end(const std::function<void()>& work, unsigned limit_s) {
  be_quiet();
  alarm(limit_s);
  try {
    work();
  } catch (...) {
    _exit(kThrew);
  }
  _exit(kReturned);
}

}  // namespace

bool comes_back(const std::function<void()>& work, unsigned limit_s) {
  const pid_t child = fork();
  if (child == 0) try_and_end(work, limit_s);
  int status = -1;
  pid_t ended = child;
  while (child > 0 && (ended = waitpid(child, &status, 0)) < 0 && errno == EINTR) {
  }
  if (ended < 0) throw std::system_error(errno, std::generic_category(), "process on trial");
  return WIFEXITED(status) && WEXITSTATUS(status) == kReturned;
}

}  // namespace scattermeter::capture
