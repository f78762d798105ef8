#include "apps/commands/questions.h"

#include <istream>
#include <iterator>
#include <ostream>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {

std::vector<std::string> Questions::ask(
    const std::string& question, const std::vector<std::string>& otherwise,
    const std::function<void(const std::vector<std::string>&)>& check) {
  for (;;) {
    out_ << question << " [" << fmt::format("{}", fmt::join(otherwise, " ")) << "]: " << std::flush;
    std::string line;
    if (!std::getline(in_, line)) return otherwise;
    std::istringstream typed(line);
    std::vector<std::string> words{std::istream_iterator<std::string>(typed), {}};
    if (words.empty()) words = otherwise;
    try {
      check(words);
      return words;
    } catch (const InputError& e) {
      out_ << e.what() << "\n";
    }
  }
}

bool at_a_terminal() { return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1; }

}  // namespace scattermeter::apps
