#include "programs/common/html_page.hpp"

namespace godwit::programs {
namespace {

constexpr std::string_view before_title = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>)";

constexpr std::string_view after_title = R"(</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 70rem; padding: 0 1rem; color: #1c2126; background: #fff }
h1 { font-size: 1.5rem } h2 { font-size: 1.1rem; margin-top: 2rem }
table { border-collapse: collapse; width: 100% } th, td { text-align: left; padding: .15rem .6rem .15rem 0; vertical-align: top }
th { font-weight: 600; border-bottom: 1px solid #9aa5b1 } td.n, th.n { text-align: right; font-variant-numeric: tabular-nums }
td.t { font-variant-numeric: tabular-nums; white-space: nowrap; color: #52606d } tr.bad td { color: #a61b1b }
svg { width: 100%; height: auto; border: 1px solid #d5dbe1; background: #f7f9fb } .note { color: #52606d }
pre { font-size: 13px; overflow-x: auto; background: #f7f9fb; border: 1px solid #d5dbe1; padding: .5rem }
</style></head><body>
)";

} // namespace

std::string html_head(std::string_view title) {
  return std::string(before_title) + html_escaped(title) + std::string(after_title);
}

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  }
  return result;
}

} // namespace godwit::programs
