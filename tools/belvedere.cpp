#include <fmt/core.h>
#include "renderer/provenance.h"
int main() { fmt::print("belvedere\n"); }
