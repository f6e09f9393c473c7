#include "report/html/page_chart.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "report/charts/plot_text.h"
#include "report/html/page_channel.h"

namespace slipcheck {

using Json = nlohmann::json;

namespace {

constexpr std::size_t kLongCurve = 100;  // points

// In the orders of Ink, Line and Marker; what is not there is null.
constexpr std::array kInks = {"black",  "blue", "vermilion", "green",
                              "purple", "grey", "orange",    "sky"};
constexpr std::array kLines = {"", "solid", "dashed", "dotted", "dash_dot"};
constexpr std::array kMarkers = {"", "circle", "triangle", "square", "diamond", "ring"};

template <std::size_t Count, typename Enum>
Json name_in(const std::array<const char*, Count>& names, Enum value) {
  const char* name = names[static_cast<std::size_t>(value)];
  return *name == '\0' ? Json() : Json(name);
}

Json text_of(const std::string& formula) { return printable(plain_plot_text(formula)); }

/// Line by line.
Json note_of(const std::string& note) {
  std::string text;
  for (std::size_t at = 0; at <= note.size();) {
    const std::size_t end = std::min(note.find('\n', at), note.size());
    text += (at > 0 ? "\n" : "") + printable(note.substr(at, end - at));
    at = end + 1;
  }
  return text;
}

template <typename Values, typename ToJson>
Json list_of(const Values& values, const ToJson& to_json) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(to_json(value));
  return list;
}

/// Points are told exactly, long lines as channels.
Json numbers_of(const std::vector<double>& values, const Look& look) {
  if (values.size() > kLongCurve && look.marker == Marker::none) return page_channel(values);
  return list_of(values, [](double value) { return page_number(value); });
}

Json axis_of(const AxisSpec& axis, const AxisRange& range) {
  Json json = {{"label", text_of(axis.label)},
               {"log", axis.logarithmic},
               {"low", page_number(range.low, 9)},
               {"high", page_number(range.high, 9)}};
  if (!axis.names.empty()) json["names"] = list_of(axis.names, text_of);
  if (!axis.runs.empty()) json["runs"] = axis.runs;
  return json;
}

Json curve_of(const Curve& curve) {
  Json json = {{"label", text_of(curve.label)},
               {"look", page_look(curve.look)},
               {"halo", curve.look.halo},
               {"edge", curve.at_edge},
               {"x", numbers_of(curve.x, curve.look)},
               {"y", numbers_of(curve.y, curve.look)}};
  if (!curve.notes.empty()) json["notes"] = list_of(curve.notes, note_of);
  return json;
}

Json pair_of(double low, double high) { return {page_number(low), page_number(high)}; }

Json panel_of(const Panel& panel) {
  const auto band = [](const Band& one) {
    return Json{{"label", text_of(one.label)},
                {"x", pair_of(one.x_low, one.x_high)},
                {"y", pair_of(one.y_low, one.y_high)}};
  };
  const auto look = [](const CellLook& one) {
    return Json{{"label", one.label}, {"letter", one.letter}, {"fill", one.fill}, {"ink", one.ink}};
  };
  const auto cell = [](const MapCell& one) {
    return Json{{"x", pair_of(one.x_low, one.x_high)},
                {"y", pair_of(one.y_low, one.y_high)},
                {"look", one.look},
                {"note", note_of(one.note)}};
  };
  Json json = {{"title", text_of(panel.title)},         {"x", axis_of(panel.x, x_range(panel))},
               {"y", axis_of(panel.y, y_range(panel))}, {"curves", list_of(panel.curves, curve_of)},
               {"bands", list_of(panel.bands, band)},   {"looks", list_of(panel.looks, look)},
               {"cells", list_of(panel.cells, cell)}};
  if (panel.truth)
    json["truth"] = {{"value", page_number(panel.truth->value, 9)},
                     {"tolerance", page_number(panel.truth->tolerance)}};
  return json;
}

}  // namespace

Json page_look(const Look& look) {
  return {{"ink", name_in(kInks, look.ink)},
          {"line", name_in(kLines, look.line)},
          {"marker", name_in(kMarkers, look.marker)}};
}

Json page_chart(const Chart& chart) {
  Json panels = Json::array();
  for (const Panel& panel : chart.panels)
    if (!panel.colours) panels.push_back(panel_of(panel));
  return {{"title", text_of(chart.title)},
          {"caption", text_of(chart.caption)},
          {"columns", chart.columns},
          {"height", chart.plot_height},
          {"panels", std::move(panels)}};
}

Json page_charts(const std::vector<Chart>& charts) { return list_of(charts, page_chart); }

Json page_palette() {
  Json palette = Json::object();
  for (std::size_t k = 0; k < kInks.size(); ++k) {
    const auto ink = static_cast<Ink>(k);
    palette[kInks[k]] = {colour_of(ink), dark_colour_of(ink)};
  }
  return palette;
}

}  // namespace slipcheck
