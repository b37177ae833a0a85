#pragma once

#include <string>

#include "base/progress.h"
#include "tools/report/synthesis_findings.h"

namespace belvedere::tools {

// index.html, report.json and the PNG pictures that the page shows, in a relocatable folder
// (created if missing) without network access: figures of quality, maps of the origin of texels, of
// their reuse and of the cost of seams and each guide, and the worst windows beside their sources.
// The same input gives the same bytes for any number of threads. Throws Error(output).
void write_synthesis_report(const std::string& folder, const SynthesisReportInput& input,
                            Progress& progress);

}  // namespace belvedere::tools
