#include "figures/gallery.h"

#include <cstdio>
#include <fstream>
#include <thread>

#include "sem/base/version.h"

namespace sem::figures {
namespace {

constexpr const char* style = R"(
body { font-family: "DejaVu Sans", sans-serif; font-size: 14px; line-height: 1.4; color: #222;
       max-width: 60em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 20px; }
figure { margin: 2em 0; padding-bottom: 1.5em; border-bottom: 1px solid #ccc; }
figure img { max-width: 100%; display: block; margin-bottom: 0.7em; }
code { background: #f3f3f3; padding: 0.1em 0.3em; }
)";

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text)
    html += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
  return html;
}

std::string link(const std::string& file, const std::string& text) {
  return "<a href=\"" + file + "\">" + text + "</a>";
}

std::string figure_html(const Figure& figure) {
  const std::string name = escaped(figure.name);
  char size[64];
  std::snprintf(size, sizeof size, "width:%gin;aspect-ratio:%g/%g", figure.width, figure.width,
                figure.height);
  return "<figure id=\"" + name + "\">\n<img src=\"" + name + ".png\" alt=\"" +
         escaped(figure.caption) + "\" style=\"" + size + "\">\n<figcaption><b>" + name + "</b>. " +
         escaped(figure.caption) + "<br>\n<code>sem_figures " + name + "</code> writes " +
         link(name + ".csv", "numbers (CSV)") + ", " + link(name + ".png", "PNG, 300 dpi") + ", " +
         link(name + ".svg", "SVG") + "</figcaption>\n</figure>\n";
}

}  // namespace

std::string machine_text() {
  std::ifstream file("/proc/cpuinfo");
  std::string processor = "unknown processor";
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      processor = line.substr(line.find(": ") + 2);
      break;
    }
  const unsigned n = std::thread::hardware_concurrency();
  return processor + ", " + std::to_string(n) + (n == 1 ? " core" : " cores");
}

std::string gallery_html(const std::vector<Figure>& figures) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<title>Figures of the Shape Matching Element Method</title>\n<style>" +
      std::string(style) +
      "</style>\n</head>\n<body>\n<h1>Figures of the Shape Matching Element "
      "Method</h1>\n<p>Each figure is drawn only from the numbers in its CSV file. Made with sem " +
      escaped(version) + ", " + escaped(build_type) + " build, " + escaped(compiler) + ", on " +
      escaped(machine_text()) + ".</p>\n<ul>\n";
  for (const auto& figure : figures)
    html += "<li>" + link("#" + escaped(figure.name), escaped(figure.name)) + ": " +
            escaped(figure.caption) + "</li>\n";
  html += "</ul>\n";
  for (const auto& figure : figures) html += figure_html(figure);
  return html + "</body>\n</html>\n";
}

}  // namespace sem::figures
