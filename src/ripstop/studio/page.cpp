#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include "ripstop/core/embedded.h"
#include "ripstop/core/file.h"
#include "ripstop/report/assets.h"
#include "ripstop/studio/server.h"

// RIPSTOP_STUDIO_PAGE is set where this file is compiled.
#define RIPSTOP_STUDIO_FILE(symbol, file) RIPSTOP_EMBEDDED(symbol, RIPSTOP_STUDIO_PAGE "/" file)

RIPSTOP_STUDIO_FILE(ripstop_studio_skeleton, "studio.html")
RIPSTOP_STUDIO_FILE(ripstop_studio_css, "studio.css")
RIPSTOP_STUDIO_FILE(ripstop_studio_words, "words.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_server, "server.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_form, "form.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_shape, "shape.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_fitting, "fitting.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_design, "design.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_runs, "runs.js")
RIPSTOP_STUDIO_FILE(ripstop_studio_main, "main.js")

namespace ripstop::inline studio {
namespace {

/// A file of the page: the built-in one, or that of the folder $RIPSTOP_STUDIO_PAGE for work on the page.
std::string page_file(const Asset& built_in) {
  const char* folder = std::getenv("RIPSTOP_STUDIO_PAGE");
  return folder && *folder ? read_file(std::filesystem::path(folder) / built_in.name)
                           : std::string(built_in.text);
}

}  // namespace

std::string studio_page(const std::string& nonce) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Ripstop "
      "Studio</title>\n"
      "<link rel=\"icon\" href=\"data:,\">\n";
  for (const Asset& style : report_styles()) page += fmt::format("<style>\n{}</style>\n", style.text);
  page += fmt::format("<style>\n{}</style>\n</head>\n{}",
                      page_file({"studio.css", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_css)}),
                      page_file({"studio.html", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_skeleton)}));
  const auto add = [&](std::string_view script) {
    page += fmt::format("<script nonce=\"{}\">\n{}</script>\n", nonce, script);
  };
  // The report's scripts but for the one that fills its page.
  for (const Asset& script : report_scripts())
    if (std::string_view(script.name) != "main.js") add(script.text);
  for (const Asset& script : std::vector<Asset>{{"words.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_words)},
                                                {"server.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_server)},
                                                {"form.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_form)},
                                                {"shape.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_shape)},
                                                {"design.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_design)},
                                                {"fitting.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_fitting)},
                                                {"runs.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_runs)},
                                                {"main.js", RIPSTOP_EMBEDDED_TEXT(ripstop_studio_main)}})
    add(page_file(script));
  return page + "</body>\n</html>\n";
}

}  // namespace ripstop::inline studio
