// Questions to the user of a terminal.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace scattermeter::apps {

class Questions {
 public:
  Questions(std::istream& in, std::ostream& out) : in_(in), out_(out) {}

  // The words of the line that is typed; `otherwise` for an empty line and at the end of the input.
  // Asks again, with the message, while `check` throws InputError for the words; they are not
  // checked at the end of the input.
  std::vector<std::string> ask(const std::string& question,
                               const std::vector<std::string>& otherwise,
                               const std::function<void(const std::vector<std::string>&)>& check);

 private:
  std::istream& in_;
  std::ostream& out_;
};

// Whether somebody sits at the input and the output of this process.
bool at_a_terminal();

}  // namespace scattermeter::apps
