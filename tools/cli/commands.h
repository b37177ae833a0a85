#pragma once

#include <functional>
#include <vector>

namespace CLI {
class App;
}

namespace belvedere::tools {

// What a command does once its options are read. Returns the exit status of a command whose answer is one (diff), else 0. Errors are
// thrown.
using Action = std::function<int()>;

// A row of the table that everything about commands comes from: help, the question after a misspelt word, the manual page, completion.
struct Command {
  const char* group;                 // the word before its name; empty: none
  const char* name;                  // what people type
  const char* meaning;               // one line of help
  Action (*add)(CLI::App& command);  // gives it options and footer
};
const std::vector<Command>& all_commands();

// A word that commands stand behind: `belvedere exemplar check`.
struct CommandGroup {
  const char* name;
  const char* meaning;
};
const std::vector<CommandGroup>& command_groups();

// One file and one row in commands.cpp a command.
Action add_cache_clear(CLI::App& command);
Action add_cache_list(CLI::App& command);
Action add_check(CLI::App& command);
Action add_completion(CLI::App& command);
Action add_deform(CLI::App& command);
Action add_diff(CLI::App& command);
Action add_exemplar_check(CLI::App& command);
Action add_exemplar_compare(CLI::App& command);
Action add_exemplar_paint(CLI::App& command);
Action add_exemplar_segment(CLI::App& command);
Action add_fetch(CLI::App& command);
Action add_generalize(CLI::App& command);
Action add_guidance(CLI::App& command);
Action add_info(CLI::App& command);
Action add_join(CLI::App& command);
Action add_features_check(CLI::App& command);
Action add_features_swatches(CLI::App& command);
Action add_labels(CLI::App& command);
Action add_layers_apply(CLI::App& command);
Action add_layers_picture(CLI::App& command);
Action add_layers_fit(CLI::App& command);
Action add_lock(CLI::App& command);
Action add_man(CLI::App& command);
Action add_new(CLI::App& command);
Action add_part(CLI::App& command);
Action add_plan(CLI::App& command);
Action add_render(CLI::App& command);
Action add_schema(CLI::App& command);
Action add_synthesize(CLI::App& command);
Action add_texture_erode(CLI::App& command);
Action add_composite_learn(CLI::App& command);
Action add_composite_make(CLI::App& command);
Action add_texture_correct(CLI::App& command);
Action add_texture_fill(CLI::App& command);
Action add_texture_judge(CLI::App& command);
Action add_texture_knit(CLI::App& command);
Action add_texture_learn(CLI::App& command);
Action add_texture_make(CLI::App& command);
Action add_verify(CLI::App& command);
Action add_web(CLI::App& command);

}  // namespace belvedere::tools
