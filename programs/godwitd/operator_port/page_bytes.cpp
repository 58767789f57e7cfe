// The bytes of the built page, which the assembler takes from its files.
#include "programs/godwitd/operator_port/page_files.hpp"

// NAME_begin and NAME_end stand around the bytes of FILE in the folder of the built page.
#define GODWIT_EMBED(NAME, FILE)                                                                                       \
  asm(".pushsection .rodata\n"                                                                                         \
      ".global godwit_page_" NAME "_begin\ngodwit_page_" NAME "_begin:\n.incbin \"" GODWIT_PAGE "/" FILE "\"\n"        \
      ".global godwit_page_" NAME "_end\ngodwit_page_" NAME "_end:\n.byte 0\n.popsection\n")

GODWIT_EMBED("index", "index.html");
GODWIT_EMBED("script", "page.js");
GODWIT_EMBED("style", "page.css");
GODWIT_EMBED("icon", "icon.svg");
GODWIT_EMBED("notice", "notice.txt");

extern "C" {
extern const char godwit_page_index_begin[];
extern const char godwit_page_index_end[];
extern const char godwit_page_script_begin[];
extern const char godwit_page_script_end[];
extern const char godwit_page_style_begin[];
extern const char godwit_page_style_end[];
extern const char godwit_page_icon_begin[];
extern const char godwit_page_icon_end[];
extern const char godwit_page_notice_begin[];
extern const char godwit_page_notice_end[];
}

namespace godwit::operator_port {

std::vector<page_file> page_files() {
  const auto between = [](const char* begin, const char* end) {
    return std::string_view(begin, static_cast<std::size_t>(end - begin));
  };
  return {{"/", "text/html; charset=utf-8", between(godwit_page_index_begin, godwit_page_index_end)},
          {"/page.js", "text/javascript; charset=utf-8", between(godwit_page_script_begin, godwit_page_script_end)},
          {"/page.css", "text/css; charset=utf-8", between(godwit_page_style_begin, godwit_page_style_end)},
          {"/icon.svg", "image/svg+xml", between(godwit_page_icon_begin, godwit_page_icon_end)},
          {"/notice.txt", "text/plain; charset=utf-8", between(godwit_page_notice_begin, godwit_page_notice_end)}};
}

} // namespace godwit::operator_port
