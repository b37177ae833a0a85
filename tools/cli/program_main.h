#pragma once

namespace belvedere::tools {

// What main() does, so that tests can call it: prepares the process, does what the command line says, and turns every error into a message
// on stderr and the exit status of its kind. The one place that catches errors.
int program_main(int argc, char** argv);

}  // namespace belvedere::tools
