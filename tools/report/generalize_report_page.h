#pragma once

#include <string>

#include "base/progress.h"
#include "tools/report/generalize_report_input.h"

namespace belvedere::tools {

// index.html, report.json and the PNG pictures that the page shows, in a relocatable folder
// (created if missing) without network access. The figures 1 to 5 of Jenny, Jenny & Hurni 2011 are
// made again from this terrain. The same input gives the same bytes for any number of threads.
// Throws Error(output).
void write_generalize_report(const std::string& folder, const GeneralizeReportInput& input,
                             Progress& progress);

}  // namespace belvedere::tools
