#include "app/view/http_request.hpp"

#include <algorithm>
#include <cctype>

namespace carom {

namespace {

constexpr std::string_view line_end = "\r\n";

// Takes the text up to a mark, and the mark, off the text; all of it if there is no mark.
std::string_view take_until(std::string_view& text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  const std::string_view taken = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + mark.size());
  return taken;
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool same_name(std::string_view a, std::string_view b) {
  const auto same = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same);
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c > 0x20 && c < 0x7f; });
}

}  // namespace

int read_request(std::string_view head, HttpRequest& request) {
  std::string_view first = take_until(head, line_end);
  const std::string_view method = take_until(first, " ");
  const std::string_view path = take_until(first, " ");
  if (!first.starts_with("HTTP/") || !path.starts_with('/') || !is_printable(path)) return 400;
  if (first != "HTTP/1.1" && first != "HTTP/1.0") return 505;
  if (method != "GET") return 405;
  int hosts = 0;
  while (!head.empty()) {
    std::string_view line = take_until(head, line_end);
    if (line.empty()) break;
    if (line.find(':') == std::string_view::npos) return 400;
    const std::string_view name = take_until(line, ":");
    if (!same_name(name, "host")) continue;
    request.host = without_blanks(line);
    ++hosts;
  }
  if (hosts != 1) return 400;
  request.path = path;
  return 200;
}

std::string_view reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "HTTP Version Not Supported";
  }
}

}  // namespace carom
