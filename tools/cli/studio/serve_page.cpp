#include "tools/cli/studio/serve_page.h"

#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "base/text/json.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// As the desktop opens addresses; where there is none the address on the terminal is all.
void open_browser(const std::string& address) {
  if (fork() != 0) return;
  setsid();  // Ctrl-C here does not end a browser that this begins
  execlp("xdg-open", "xdg-open", address.c_str(), static_cast<char*>(nullptr));
  _exit(1);
}

}  // namespace

void add_page_options(CommandOptions& command, PageOptions& options) {
  command.add_option("--port N", options.port, "Port of this machine; 0: any that is free")
      .range(0, 65535);
  command.add_flag("--headless", options.headless,
                   "No browser; the address is printed as JSON, for programs");
}

void serve_page(const ServedPage& page, bool headless) {
  if (headless)
    print_out(Json::object().add("address", Json::text(page.address)).str() + "\n");
  else
    print_out(fmt::format("{}\nCtrl-C ends it.\n", page.address));
  finish_output();
  if (!headless) open_browser(page.address);
  // A signal can only set a flag.
  std::atomic<bool> ended = false;
  std::thread watch([&] {
    while (!interrupted() && !ended && (headless || !page.is_left()))
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    page.stop();
  });
  page.run();
  ended = true;
  watch.join();
}

}  // namespace belvedere::tools
