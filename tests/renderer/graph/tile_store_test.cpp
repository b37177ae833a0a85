#include "renderer/graph/tile_store.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/files.h"

namespace belvedere {
namespace {

// Other behaviour of tile stores is tested by the stages that use them (stage_graph_test.cpp).
TEST(TileStore, AFolderThatCannotBeWrittenIsAnErrorOfTheOutput) {
  const std::string message = test::message_of(ErrorKind::output, [] {
    TileStore::Place position{"/proc/nowhere", 0};
    TileStore store(position, 10, 10, 8, {1});
    Grid<std::uint8_t> values(8, 8);
    store.put(0, 0, {0, 0, 8, 8}, {plane_of(values)});
  });
  EXPECT_NE(message.find("scratch"), std::string::npos) << message;
}

TEST(TileStore, PlanesAndPlacesThatAreNotTheTilesAreRefused) {
  const test::Folder folder;
  TileStore::Place position{folder.path(), 1000};
  TileStore store(position, 10, 10, 8, {1});
  Grid<std::uint8_t> wrong(7, 8);
  test::message_of(ErrorKind::bug, [&] { store.put(0, 0, {0, 0, 8, 8}, {plane_of(wrong)}); });
  test::message_of(ErrorKind::bug, [&] { store.put(0, 0, {1, 0, 9, 8}, {plane_of(wrong)}); });
}

}  // namespace
}  // namespace belvedere
