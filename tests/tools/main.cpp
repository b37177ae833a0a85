#include <gmock/gmock.h>

#include "tests/tools/program_server.h"

int main(int argc, char** argv) {
  belvedere::test::start_program_server();
  ::testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
