// A browser's request, as far as a server that only hands out pages must understand it.
#pragma once

#include <string>
#include <string_view>

namespace carom {

struct HttpRequest {
  std::string path;  // as it was sent, query and all
  std::string host;  // as the browser names the server
};

// The longest head of a request, bytes.
inline constexpr std::size_t longest_request = 8192;

// Reads the head of a request (RFC 9112), all up to and with its blank line. Returns the status to answer with: 200
// where it is a GET for a path that a browser could send, else 400 (malformed, no host or several), 405 (not a GET) or
// 505 (not HTTP/1).
int read_request(std::string_view head, HttpRequest& request);

// What the status means, for the first line of an answer.
std::string_view reason_of(int status);

}  // namespace carom
