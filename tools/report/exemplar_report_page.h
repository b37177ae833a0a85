#pragma once

#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "tools/report/exemplar_verdict.h"

namespace belvedere::tools {

// The findings of `exemplar check` with pictures, in a relocatable folder without network access:
// index.html, report.json, each painting beside its classes, a swatch of every class, and for each
// guide the values at which a class was painted and, where `asked` has labels (those that pixels
// copy from) and the guide, the values asked for. exemplars: those of the findings. Throws
// Error(output).
void write_exemplar_report(const std::string& folder, const std::vector<Exemplar>& exemplars,
                           const GuideStack& asked, const ExemplarFindings& findings,
                           const std::string& command);

}  // namespace belvedere::tools
