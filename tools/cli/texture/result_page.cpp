#include "tools/cli/texture/result_page.h"

#include <cstddef>

#include "base/text/markup.h"
#include "renderer/image/output_file.h"
#include "tools/options/options.h"
#include "tools/report/report_folder.h"

namespace belvedere::tools {

void add_report_option(CommandOptions& command, std::string& folder, const std::string& meaning) {
  command.add_option("--report", folder, meaning).type_name("FOLDER");
}

void check_report(const std::string& folder) {
  if (!folder.empty()) check_output_folder(folder);
}

void write_result_page(const std::string& folder, const ResultPage& page) {
  ReportFolder out(folder);
  out.begin_figure("pictures", "Pictures", markup_text(page.how_to_read));
  for (std::size_t r = 0; r < page.rows.size(); ++r) {
    if (r > 0) out.next_row();
    for (const PagePicture& picture : page.rows[r]) out.picture(picture.name, picture.pixels, markup_text(picture.caption));
  }
  out.end_figure();
  if (!page.table.empty()) {
    std::string rows;
    for (std::size_t r = 0; r < page.table.size(); ++r) {
      std::vector<std::string> cells;
      for (const std::string& cell : page.table[r]) cells.push_back(markup_text(cell));
      rows += html_row(cells, r == 0 ? "th" : "td");
    }
    out.add("<h2>Figures</h2><table>" + rows + "</table>");
  }
  out.write_page(page.title, page.heading, page.lead, page.command);
}

}  // namespace belvedere::tools
