#include "io/view/view_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <span>
#include <string_view>

#include "core/base/check.hpp"
#include "core/scene/scene_names.hpp"
#include "io/view/base64.hpp"

namespace carom {

namespace {

// A JSON string that may be in a script element, which "<" could end.
std::string json_string(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || std::strchr("<>&\"\\'", c) != nullptr || code == 0x7f) {
      json += fmt::format("\\u{:04x}", code);
    } else {
      json += c;
    }
  }
  return json + '"';
}

std::string html_text(std::string_view text) {
  std::string html;
  for (const char c : text) {
    if (c == '<') {
      html += "&lt;";
    } else if (c == '>') {
      html += "&gt;";
    } else if (c == '&') {
      html += "&amp;";
    } else {
      html += c;
    }
  }
  return html;
}

template <class Items, class Write>
std::string json_list(const Items& items, Write write) {
  std::string json = "[";
  for (const auto& item : items) {
    if (json.size() > 1) json += ',';
    json += write(item);
  }
  return json + ']';
}

// JSON has no notation for values that are not numbers.
std::string json_number(double value, const char* form = "{}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(form), value) : "null";
}

std::string bytes_of_word(std::uint64_t word, unsigned bytes) {
  std::string text;
  for (unsigned k = 0; k < bytes; ++k) text += static_cast<char>(word >> (8 * k));
  return text;
}

void put_numbers(std::string& to, const std::vector<double>& values) {
  for (const double value : values) {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof bits);
    to += bytes_of_word(bits, 8);
  }
}

// The common value of all, as JSON, or null if they differ.
std::string common_value(const std::vector<double>& values) {
  const auto differs = [&](double value) { return value != values.front(); };
  if (values.empty() || std::any_of(values.begin(), values.end(), differs)) return "null";
  return json_number(values.front());
}

DiskId first_group(const ViewDisks& disks) {
  return disks.group.empty() ? 0 : disks.group.front();
}

bool several_groups(const ViewDisks& disks) {
  const auto differs = [&](DiskId group) { return group != first_group(disks); };
  return std::any_of(disks.group.begin(), disks.group.end(), differs);
}

// The times of frames, then the ids, radii and masses (if they differ) and groups of all disks: viewer/decode.js.
std::string table_of(const ViewEncoder& encoder) {
  const ViewDisks& disks = encoder.disks();
  std::string table;
  put_numbers(table, encoder.times());
  if (common_value(disks.radius) == "null") put_numbers(table, disks.radius);
  if (common_value(disks.mass) == "null") put_numbers(table, disks.mass);
  for (const DiskId id : disks.id) table += bytes_of_word(id, 4);
  if (!several_groups(disks)) return table;
  for (const DiskId group : disks.group) table += bytes_of_word(group, 4);
  return table;
}

std::string_view word_of(SideKind kind) {
  return side_kind_names[static_cast<std::size_t>(kind)];
}

std::string_view word_of(ColourBy colour) {
  return colour_names[static_cast<std::size_t>(colour)];
}

std::string json_of_box(const Domain& box) {
  return fmt::format(R"({{"width":{},"height":{},"shear":{},"sides":{},"thermal":{}}})", box.width, box.height,
                     box.shear.rate,
                     json_list(box.sides, [](SideKind kind) { return fmt::format("\"{}\"", word_of(kind)); }),
                     json_list(all_sides, [&](Side side) { return box.is_thermal(side) ? "true" : "false"; }));
}

// The distance of each moving side from the edge of the box in each frame; null for sides at rest.
std::string json_of_insets(const Domain& box, std::span<const double> times) {
  return json_list(box.motions, [&](const SideMotion& motion) {
    const auto inset = [&](double t) { return json_number(motion.at(t).inset, "{:.6g}"); };
    return motion.moves() ? json_list(times, inset) : std::string("null");
  });
}

// The displacement of each moving [[walls]] table in each frame; null for tables at rest.
std::string json_of_shifts(const std::vector<WallMotion>& motions, std::span<const double> times) {
  return json_list(motions, [&](const WallMotion& motion) {
    const auto shift = [&](double t) {
      const Vec2 moved = motion.at({t, t}).shift;
      return fmt::format("[{:.6g},{:.6g}]", moved.x, moved.y);
    };
    return motion.moves() ? json_list(times, shift) : std::string("null");
  });
}

std::string json_of_block(const ViewBlock& block) {
  return fmt::format("[{},{},{},{},{}]", block.first, block.frames, block.residuals, block.packed.size(), block.check);
}

// Fixed disks, or the segments of inner walls with the number of their table.
std::string json_of_obstacles(const std::vector<Obstacle>& obstacles, bool segments) {
  std::vector<Obstacle> chosen;
  std::copy_if(obstacles.begin(), obstacles.end(), std::back_inserter(chosen),
               [&](const Obstacle& o) { return o.is_segment() == segments; });
  return json_list(chosen, [&](const Obstacle& o) {
    return segments ? fmt::format("[{:.7g},{:.7g},{:.7g},{:.7g},{},{}]", o.x, o.y, o.x + o.dx, o.y + o.dy,
                                  o.kind == ObstacleKind::sink ? 1 : 0, o.id)
                    : fmt::format("[{:.7g},{:.7g},{:.7g}]", o.x, o.y, o.radius);
  });
}

std::string json_of_source(const ViewSource& source) {
  if (source.side) return fmt::format(R"({{"side":{}}})", static_cast<int>(*source.side));
  return fmt::format(R"({{"region":[{},{},{},{}]}})", source.low.x, source.low.y, source.high.x, source.high.y);
}

std::string json_of_series(const ViewSeries& series) {
  const auto column = [](const std::vector<double>& values) {
    return json_list(values, [](double value) { return json_number(value, "{:.5g}"); });
  };
  return fmt::format(R"({{"names":{},"columns":{}}})", json_list(series.names, json_string),
                     json_list(series.columns, column));
}

std::string json_of_curve(const AnalysisCurve& curve) {
  const auto numbers = [](const std::vector<double>& values) {
    return json_list(values, [](double value) { return json_number(value, "{:.5g}"); });
  };
  return fmt::format(R"({{"name":{},"x":{},"y":{},"inTime":{}}})", json_string(curve.name), numbers(curve.x),
                     numbers(curve.y), curve.in_time);
}

// The part that the page reads first: everything except the frames and the table, with the length and checksum of each.
std::string head_of(const ViewStory& story, const ViewEncoder& encoder, std::string_view table,
                    const std::vector<std::string>& left_out) {
  const ViewDisks& disks = encoder.disks();
  std::string json =
      fmt::format(R"({{"form":1,"version":{},"title":{},"box":{},"colour":"{}")", json_string(CAROM_VERSION),
                  json_string(story.title), json_of_box(story.box), word_of(story.colour));
  json += fmt::format(R"(,"groups":{},"sources":{},"leftOut":{})", json_list(story.groups, json_string),
                      json_list(story.sources, json_of_source), json_list(left_out, json_string));
  json += fmt::format(R"(,"frames":{},"disks":{},"radius":{},"mass":{},"grouped":{},"group":{})",
                      encoder.times().size(), disks.id.size(), common_value(disks.radius), common_value(disks.mass),
                      several_groups(disks), first_group(disks));
  json += fmt::format(R"(,"insets":{},"obstacles":{},"walls":{})", json_of_insets(story.box, encoder.times()),
                      json_of_obstacles(story.obstacles, false), json_of_obstacles(story.obstacles, true));
  json += fmt::format(R"(,"shifts":{})", json_of_shifts(story.wall_motions, encoder.times()));
  json += fmt::format(R"(,"axes":{})", json_list(encoder.axes(), [](const ViewAxis& axis) {
                        return fmt::format(R"({{"bits":{},"periodic":{},"quantum":{}}})", axis.bits, axis.periodic,
                                           axis.quantum());
                      }));
  json += fmt::format(R"(,"fast":{})", json_number(encoder.fast_speed(), "{:.4g}"));
  json += fmt::format(R"(,"table":{{"bytes":{},"check":{}}})", table.size(), crc_of(table));
  json += fmt::format(R"(,"blocks":{})", json_list(encoder.blocks(), json_of_block));
  return json + fmt::format(R"(,"series":{},"curves":{}}})", json_of_series(story.series),
                            json_list(story.curves, json_of_curve));
}

// Writes the page up to the marker, which is left out, and returns the rest behind it.
std::string_view put_until(std::string& to, std::string_view page, std::string_view marker) {
  const std::size_t at = page.find(marker);
  if (at == std::string_view::npos) throw RunError(fmt::format("the page of the viewer lacks {}", marker));
  to += page.substr(0, at);
  return page.substr(at + marker.size());
}

// The values of the new disks, as JSON.
template <class Values>
std::string json_of_new(const Values& values, std::size_t known) {
  const auto rest = std::span(values).subspan(std::min(known, values.size()));
  return json_list(rest, [](auto value) { return fmt::format("{}", value); });
}

std::string block_element(const std::string& id, std::string_view text) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
}

// The page up to its blocks; the part behind them is stored in `rest`.
std::string begin_page(const ViewStory& story, const ViewEncoder& encoder, const std::vector<std::string>& left_out,
                       bool live, std::string_view& rest) {
  const std::string table = deflated(table_of(encoder));
  std::string html;
  html.reserve((live ? 0 : encoder.packed_bytes() / 3 * 4) + table.size() / 3 * 4 + 200'000);
  rest = put_until(html, viewer_page, "<!--carom:policy-->");
  if (live) html += viewer_live_policy;
  rest = put_until(html, rest, "<!--carom:title-->");
  html += html_text(story.title.empty() ? "a run" : story.title);
  rest = put_until(html, rest, "<!--carom:head-->");
  html += head_of(story, encoder, table, left_out);
  rest = put_until(html, rest, "<!--carom:live-->");
  if (live) html += viewer_live_script;
  rest = put_until(html, rest, "<!--carom:blocks-->");
  return html + block_element("table", base64(table));
}

}  // namespace

std::string block_text(const ViewEncoder& encoder, std::size_t k) {
  return base64(encoder.blocks()[k].packed);
}

std::string view_page(const ViewStory& story, const ViewEncoder& encoder, const std::vector<std::string>& left_out) {
  std::string_view rest;
  std::string html = begin_page(story, encoder, left_out, false, rest);
  for (std::size_t k = 0; k < encoder.blocks().size(); ++k) {
    html += block_element(fmt::format("block{}", k), block_text(encoder, k));
  }
  html += rest;
  return html;
}

std::string live_page(const ViewStory& story, const ViewEncoder& encoder) {
  std::string_view rest;
  std::string html = begin_page(story, encoder, {"follows a run that goes on"}, true, rest);
  html += rest;
  return html;
}

std::string view_news(const ViewStory& story, const ViewEncoder& encoder, std::size_t blocks, std::size_t disks,
                      std::string_view state, bool ended) {
  const ViewDisks& all = encoder.disks();
  const auto fresh = std::span(encoder.blocks()).subspan(blocks);
  const std::size_t frames = fresh.empty() ? encoder.times().size() : fresh.front().first;
  const auto times = std::span(encoder.times()).subspan(frames);
  std::string json =
      fmt::format(R"({{"state":{},"ended":{},"blocks":{},"times":{})", json_string(state), ended,
                  json_list(fresh, json_of_block), json_list(times, [](double t) { return json_number(t); }));
  json += fmt::format(R"(,"insets":{},"shifts":{},"id":{},"radius":{},"mass":{},"group":{})",
                      json_of_insets(story.box, times), json_of_shifts(story.wall_motions, times),
                      json_of_new(all.id, disks), json_of_new(all.radius, disks), json_of_new(all.mass, disks),
                      json_of_new(all.group, disks));
  return json + fmt::format(R"(,"fast":{},"series":{}}})", json_number(encoder.fast_speed(), "{:.4g}"),
                            json_of_series(story.series));
}

}  // namespace carom
