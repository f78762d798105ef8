// A rig at an eighth of the sample's resolution, with meshes, in a folder of its own.
#pragma once

#include <string>
#include <vector>

#include "apps/command_line.h"
#include "tests/temporary_folder.h"

namespace scattermeter::apps {

// What a run of the program answered.
struct Answer {
  int status = -1;
  std::string out;
  std::string err;
};
Answer run(const std::vector<std::string>& arguments);

// Replaces the only occurrence of `from`; throws where there is none or more than one.
std::string replaced(std::string text, const std::string& from, const std::string& to);

std::string slurp(const std::string& path);

class SmallRig {
 public:
  SmallRig();

  // The rig's text as it stands on disk, and putting another there. Twelve shots; `keep_shots`
  // drops all but those whose line holds the text.
  const std::string& text() const { return text_; }
  void write(const std::string& text);
  void keep_shots(const std::string& holding);

  std::string rig() const { return folder_ / "rig.yaml"; }
  std::string shots() const { return folder_ / "shots"; }
  std::string out() const { return folder_ / "out"; }
  std::string operator/(const std::string& name) const { return folder_ / name; }

  // simulate into shots(); throws unless it succeeds.
  void simulate(const std::vector<std::string>& more = {});
  Answer measure(const std::vector<std::string>& more = {}) const;
  // out()/result.json as text; "" where there is none.
  std::string result() const;

 private:
  TemporaryFolder folder_;
  std::string text_;
};

}  // namespace scattermeter::apps
