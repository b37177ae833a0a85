#pragma once

#include <functional>
#include <string>

namespace belvedere::tools {

class CommandOptions;

// A server of a page: a Studio, or a Picking.
struct ServedPage {
  std::string address;
  std::function<void()> run;  // until stop(), from another thread
  std::function<void()> stop;
  std::function<bool()> is_left;  // whether the page was closed
};
template <class Server>
ServedPage served_page(Server& server) {
  return {server.address(), [&server] { server.run(); }, [&server] { server.stop(); },
          [&server] { return server.is_left(); }};
}

struct PageOptions {
  int port = 0;
  bool headless = false;
};
void add_page_options(CommandOptions& command, PageOptions& options);

// Says the address, opens the browser on it and serves the page until it is closed or Ctrl-C.
// headless: no browser, the address is said as JSON, and the page's closing ends nothing.
void serve_page(const ServedPage& page, bool headless);

}  // namespace belvedere::tools
