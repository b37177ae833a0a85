#pragma once

#include <string>

#include "base/progress.h"
#include "tools/report/synthesis_report_input.h"

namespace belvedere::tools {

// index.html, report.json and the PNG pictures that the page shows, in a folder (made where it is missing) that can be moved and read
// without a network: figures of quality, maps of where texels come from, of their reuse and of what seams and each guide cost, and the
// worst places beside their sources. The same input gives the same bytes for any number of threads. Throws Error(output).
void write_synthesis_report(const std::string& folder, const SynthesisReportInput& input, Progress& progress);

}  // namespace belvedere::tools
