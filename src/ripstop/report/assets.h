// Scripts, styles and skeleton of the report, which lie in page/ and vendor/ and are part of the program.
#pragma once

#include <string_view>
#include <vector>

namespace ripstop::inline report {

struct Asset {
  const char* name;  // "viewer.js"
  std::string_view text;
};

std::string_view report_skeleton();   // page/page.html
std::vector<Asset> report_styles();   // in the order of the page
std::vector<Asset> report_scripts();  // each needs those before it

}  // namespace ripstop::inline report
