#pragma once
// The figures on one page for a browser.

#include <string>
#include <vector>

#include "figures/figure.h"

namespace sem::figures {

/// One HTML page, without scripts, of the figures: each at its printed size, its caption, the
/// command that makes it, links to its files (beside the page), and a line about the machine and
/// the build.
std::string gallery_html(const std::vector<Figure>& figures);

/// Name of the processor and number of its cores, e.g. "AMD EPYC 7B13, 2 cores".
std::string machine_text();

}  // namespace sem::figures
