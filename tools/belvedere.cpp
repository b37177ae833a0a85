#include "tools/cli/program_main.h"

int main(int argc, char** argv) { return belvedere::tools::program_main(argc, argv); }
