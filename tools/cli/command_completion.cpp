#include <memory>
#include <string>

#include "tools/cli/commands.h"
#include "tools/cli/program.h"
#include "tools/cli/shell_completion.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {

Action add_completion(CommandOptions& command) {
  const auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "The shell").required().one_of(completed_shells());
  command.footer(
      "An installed program includes all of them. Without installation:\n"
      "\n"
      "  belvedere completion bash > ~/.local/share/bash-completion/completions/belvedere\n"
      "  belvedere completion fish > ~/.config/fish/completions/belvedere.fish\n"
      "  belvedere completion zsh > ~/.zfunc/_belvedere      where ~/.zfunc is part of $fpath");
  return [shell] {
    print_out(shell_completion(describe_program(), *shell));
    return 0;
  };
}

}  // namespace belvedere::tools
