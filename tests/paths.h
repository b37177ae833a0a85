#pragma once

#include <string>

// Where tests find the project, the programs that were built with them, and real data.
namespace belvedere::test {

std::string source_folder();
std::string build_folder();
// Real data lies beside the project unless $BELVEDERE_DATA names another folder; tests that need it
// skip, and say so, where it is missing.
std::string data_folder();

}  // namespace belvedere::test
