#include "tools/cli/program.h"

int main(int argc, char** argv) { return belvedere::tools::program_main(argc, argv); }
