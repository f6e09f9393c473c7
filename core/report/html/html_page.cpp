#include "report/html/html_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/html/html_text.h"
#include "report/html/packed_text.h"
#include "report/page_css.h"

namespace slipcheck {

std::string html_head(std::string_view title, std::string_view more_css,
                      const std::vector<std::string_view>& scripts) {
  std::string policy = "default-src 'none'; style-src 'unsafe-inline'";
  if (!scripts.empty()) {
    policy += "; script-src";
    for (const std::string_view script : scripts)
      policy += fmt::format(" '{}'", source_hash(script));
    policy += "; img-src data: blob:";
  }
  std::string html = fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="{}"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="color-scheme" content="light dark"/>
<title>{}</title>
<style>
)",
                                 policy, escaped(title));
  html += kPageCss;
  html += more_css;
  return html + "</style>\n</head>\n<body>\n";
}

std::string html_fact(std::string_view name, std::string_view value) {
  if (value.empty()) return {};
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string html_context(const Context& c, const std::vector<std::string>& commands,
                         const std::vector<std::string>& engines) {
  std::string html = "<dl class=\"context\">\n";
  for (const std::string& command : commands) html += html_fact("command", command);
  const std::string warning = c.build == context().build ? debug_build_warning() : "";
  html += html_fact("date", c.date) +
          html_fact("slipcheck", fmt::format("{}, commit {}", c.version, c.commit)) +
          html_fact("engines", fmt::format("{}", fmt::join(engines, ", "))) +
          html_fact("build", fmt::format("{}, {}", c.build, c.compiler)) +
          html_fact("processor", fmt::format("{}, {} hardware threads", c.cpu, c.cores)) +
          html_fact("system", c.system) + html_fact("warning", warning) + "</dl>\n";
  return html_details("Command, versions and machine", html);
}

}  // namespace slipcheck
