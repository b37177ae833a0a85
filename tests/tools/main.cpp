#include <gmock/gmock.h>

#include "renderer/image/oiio_file.h"
#include "tests/tools/program_server.h"

int main(int argc, char** argv) {
  belvedere::load_oiio();  // once, for every program that the server starts
  belvedere::test::start_program_server();
  ::testing::InitGoogleMock(&argc, argv);
  const int status = RUN_ALL_TESTS();
  belvedere::test::stop_program_server();
  return status;
}
