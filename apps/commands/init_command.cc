#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <ostream>
#include <set>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/commands/questions.h"
#include "apps/drafting/drafted_body.h"
#include "apps/drafting/rig_draft.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

struct InitArguments {
  std::string shots, out = "rig.yaml", board, material = "material";
  std::vector<std::string> bodies = {"cube:20"}, leds = {"led1", "led2"};
  bool is_example = false, asks_nothing = false;
};

struct NewFile {
  std::string path, text;
};

struct Draft {
  ShotListing listing;
  std::vector<NewFile> meshes;
  DraftedRig rig;
};

// Throws InputError for a file that there is already.
void require_free(const std::string& path, const std::string& otherwise) {
  if (fs::exists(path)) {
    throw InputError(path, "exists already; init does not overwrite files: " + otherwise);
  }
}

void require_free(const std::vector<NewFile>& meshes) {
  for (const NewFile& mesh : meshes) {
    require_free(
        mesh.path,
        "if it is the mesh of the piece, pass it to --body; otherwise choose another --out");
  }
}

// rig.schema.json as it stands beside the program, installed or built; "": it does not.
std::string schema_path() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path path = program.parent_path().parent_path() / "share/scattermeter/rig.schema.json";
  return !error && fs::exists(path, error) ? path.string() : "";
}

// The object of --body, and its mesh if it is to be written.
DraftedObject object_of(const std::string& body, const fs::path& folder,
                        std::vector<NewFile>& files) {
  const DraftedBody drafted = drafted_body(body);
  std::string mesh = drafted.name + ".obj";
  if (body.ends_with(".obj")) {
    // The folder may have to be created.
    mesh = fs::weakly_canonical(fs::absolute(body))
               .lexically_relative(fs::weakly_canonical(fs::absolute(folder / ".")))
               .string();
  } else {
    files.push_back({(folder / mesh).string(), obj_text(drafted.mesh)});
  }
  return {drafted.name, mesh, bounds(drafted.mesh)};
}

template <class Named>
void require_distinct(const std::vector<Named>& all, const char* option) {
  std::set<std::string> names;
  for (const Named& one : all) {
    if (!names.insert(one.name).second) throw InputError(option, "names " + one.name + " twice");
  }
}

// Writes the rig, the last of the files, with its meshes. What cannot be measured with is not kept.
void write_rig(const std::string& path, const std::vector<NewFile>& files) {
  for (const NewFile& file : files) capture::write_text_file(file.path, file.text);
  try {
    open_objects(read_rig(path));
  } catch (const InputError& error) {
    for (const NewFile& file : files) fs::remove(file.path);
    throw InputError("init",
                     std::string("the options do not describe a valid rig; nothing is written: ") +
                         error.what());
  }
}

// Everything that is to be written. Throws InputError for what the arguments name and cannot be
// drafted; whether files are in the way is not looked at.
Draft draft_of(const InitArguments& a, const ShotListing& listing) {
  Draft out;
  RigDraft draft;
  draft.material = a.material;
  draft.is_example = a.is_example;
  draft.schema_path = schema_path();
  if (!a.board.empty()) draft.board = drafted_board(a.board);
  for (const std::string& led : a.leds) draft.leds.push_back(drafted_led(led));
  for (const std::string& body : a.bodies) {
    draft.objects.push_back(object_of(body, fs::path(a.out).parent_path(), out.meshes));
  }
  require_distinct(draft.objects, "--body");
  require_distinct(draft.leds, "--led");
  draft.listing = a.is_example ? example_listing(draft.leds) : listing;
  out.rig = drafted_rig(draft);
  out.listing = std::move(draft.listing);
  return out;
}

// Asks for what the command line leaves open, each question until the draft with its answer can be
// written.
void ask_for_the_rest(const CLI::App& command, const ShotListing& listing, std::ostream& out,
                      InitArguments& a) {
  using Words = std::vector<std::string>;
  Questions questions(std::cin, out);
  const auto ask = [&](const char* option, const std::string& question, const Words& otherwise,
                       const std::function<void(InitArguments&, const Words&)>& take) {
    if (command.count(option) > 0) return;
    take(a, questions.ask(question, otherwise, [&](const Words& words) {
      InitArguments with = a;
      take(with, words);
      const Draft draft = draft_of(with, listing);
      if (option == std::string("--body")) require_free(draft.meshes);
    }));
  };
  ask("--body",
      "Which piece? A body with sizes in mm (cube:20, box:30x20x10, slab:40x40x10, "
      "pyramid:20x20x15, cylinder:20x20x30, sphere:20), or a mesh file",
      a.bodies, [](InitArguments& with, const Words& words) { with.bodies = words; });
  ask("--material", "Of which material?", {a.material},
      [](InitArguments& with, const Words& words) {
        with.material = fmt::format("{}", fmt::join(words, " "));
      });
  ask("--led",
      "Which LEDs? Their names, each with its position in mm if you know it "
      "(left:-60,-80,120)",
      a.leds, [](InitArguments& with, const Words& words) { with.leds = words; });
  ask("--board", "Which ChArUco board? Squares, mm of a square and of a marker", {kUsualBoard},
      [](InitArguments& with, const Words& words) {
        // What is only taken for granted stays a placeholder.
        with.board = words[0] == kUsualBoard ? "" : words[0];
      });
}

int run_init(InitArguments a, const CLI::App& command, CommandContext& context) {
  if (a.shots.empty() != a.is_example) {
    throw InputError("init", "needs the folder of the shots, or --example without one");
  }
  // What can fail does so before a question is asked, whose answer would be lost.
  capture::require_output_file(a.out);
  require_free(a.out, "choose another --out");
  const ShotListing listing = a.is_example ? ShotListing{} : list_shots(a.shots);
  if (!a.is_example && !a.asks_nothing && !context.quiet && at_a_terminal()) {
    const Draft given = draft_of(a, listing);
    if (command.count("--body") > 0) require_free(given.meshes);
    ask_for_the_rest(command, listing, context.out, a);
  }
  const Draft draft = draft_of(a, listing);
  require_free(draft.meshes);
  std::vector<NewFile> files = draft.meshes;
  files.push_back({a.out, draft.rig.yaml});
  write_rig(a.out, files);
  for (const std::string& skipped : draft.listing.skipped) {
    context.err << "scattermeter: left out: " << skipped << "\n";
  }
  if (context.quiet) return 0;
  const std::size_t n = draft.listing.shots.size();
  context.out << n << (n == 1 ? " shot" : " shots") << " by a " << draft.listing.model << ", "
              << draft.listing.width_px << " x " << draft.listing.height_px << " px\n";
  for (const NewFile& file : files) context.out << "written: " << file.path << "\n";
  if (draft.rig.to_measure.empty()) {
    context.out << "try: scattermeter simulate " << a.out << " --out shots\n";
    return 0;
  }
  context.out << "still to be measured (marked MEASURE in " << a.out << "):\n";
  for (const std::string& what : draft.rig.to_measure) context.out << "  - " << what << "\n";
  context.out << "then: scattermeter check " << a.shots << " --rig " << a.out << "\n";
  return 0;
}

}  // namespace

void add_init_command(CLI::App& app, CommandContext& context) {
  const auto a = std::make_shared<InitArguments>();
  CLI::App* command = app.add_subcommand(
      "init",
      "Begin a rig file from the raw shots of a folder.\n"
      "Camera, size and the list of shots are read from the raws, their exposures stand beside "
      "them; meshes of simple bodies are written. What no file tells is a placeholder, marked "
      "MEASURE and listed at the end. Existing files are not replaced. On a terminal, what the "
      "options leave open is asked for.");
  command->add_option("SHOTS", a->shots, "folder of the raw files");
  command->add_option("--out", a->out, "rig file to write; meshes go to its folder")
      ->capture_default_str();
  command
      ->add_option("--body", a->bodies,
                   "piece in mm: cube:20, box:30x20x10, slab:40x40x10, pyramid:20x20x15, "
                   "cylinder:20x20x30, sphere:20, or a mesh (.obj); may be repeated")
      ->capture_default_str();
  command
      ->add_option("--led", a->leds,
                   "name of an LED and, if known, its position in mm: "
                   "left:-60,-80,120; may be repeated")
      ->capture_default_str();
  command->add_option("--board", a->board,
                      "ChArUco board: squares, mm of a square and of a marker: 10x7:6:4.5");
  command->add_option("--material", a->material, "name of the material")->capture_default_str();
  command->add_flag("--example", a->is_example,
                    "no shots: a rig with a truth, to be simulated, measured and changed");
  command->add_flag("--no-questions", a->asks_nothing,
                    "ask nothing: defaults and placeholders for what the options leave open");
  run_if_named(*command, context,
               [a, command, &context] { return run_init(*a, *command, context); });
}

}  // namespace scattermeter::apps
