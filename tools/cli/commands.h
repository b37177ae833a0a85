#pragma once

#include <functional>
#include <string>
#include <vector>

namespace belvedere::tools {

class CommandOptions;

// The action of a command once its options are read. Returns the exit status of a command whose
// result is one (diff), else 0. Errors are thrown.
using Action = std::function<int()>;

// A row of the table that defines all commands: help, the suggestion for a misspelt word, the
// manual page and completion use it.
struct Command {
  const char* group;                       // the word before its name; empty: none
  const char* name;                        // the name that users type
  const char* meaning;                     // one line of help
  Action (*add)(CommandOptions& command);  // adds options and footer to it
  const char* heading = nullptr;           // in the help; null: that of its group
};
const std::vector<Command>& all_commands();

// A word with commands below it: `belvedere exemplar check`.
struct CommandGroup {
  const char* name;
  const char* meaning;
  const char* heading;  // in the help
};
const std::vector<CommandGroup>& command_groups();

// One file and one row in commands.cpp per command.
Action add_cache_clear(CommandOptions& command);
Action add_cache_list(CommandOptions& command);
Action add_check(CommandOptions& command);
Action add_completion(CommandOptions& command);
Action add_deform(CommandOptions& command);
Action add_diff(CommandOptions& command);
Action add_exemplar_check(CommandOptions& command);
Action add_exemplar_paint(CommandOptions& command);
Action add_exemplar_pick(CommandOptions& command);
Action add_exemplar_register(CommandOptions& command);
Action add_exemplar_segment(CommandOptions& command);
Action add_fetch(CommandOptions& command);
Action add_figure(CommandOptions& command);
Action add_generalize(CommandOptions& command);
Action add_guidance(CommandOptions& command);
Action add_info(CommandOptions& command);
Action add_join(CommandOptions& command);
Action add_features_check(CommandOptions& command);
Action add_features_swatches(CommandOptions& command);
Action add_labels(CommandOptions& command);
Action add_layers_apply(CommandOptions& command);
Action add_layers_picture(CommandOptions& command);
Action add_layers_fit(CommandOptions& command);
Action add_lock(CommandOptions& command);
Action add_man(CommandOptions& command);
Action add_new(CommandOptions& command);
Action add_part(CommandOptions& command);
Action add_palette_check(CommandOptions& command);
Action add_pdf(CommandOptions& command);
Action add_plan(CommandOptions& command);
Action add_proof(CommandOptions& command);
Action add_render(CommandOptions& command);
Action add_schema(CommandOptions& command);
Action add_studio(CommandOptions& command);
Action add_style_fit(CommandOptions& command);
Action add_synthesize(CommandOptions& command);
Action add_texture_erode(CommandOptions& command);
Action add_composite_learn(CommandOptions& command);
Action add_composite_make(CommandOptions& command);
Action add_texture_correct(CommandOptions& command);
Action add_texture_fill(CommandOptions& command);
Action add_texture_plant(CommandOptions& command);
Action add_texture_remove(CommandOptions& command);
Action add_texture_seam(CommandOptions& command);
Action add_texture_learn(CommandOptions& command);
Action add_texture_make(CommandOptions& command);
Action add_sweep(CommandOptions& command);
Action add_verify(CommandOptions& command);
Action add_web(CommandOptions& command);

// A file's name without its folders, so that messages and headers are the same wherever files are.
std::string file_name(const std::string& path);

}  // namespace belvedere::tools
