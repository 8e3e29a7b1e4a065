// A browser's request, as far as a server that only sends pages must understand it.
#pragma once

#include <string>
#include <string_view>

namespace carom {

struct HttpRequest {
  std::string path;  // as it was sent, with any query
  std::string host;  // the server's name in the browser
};

// The longest head of a request, bytes.
inline constexpr std::size_t longest_request = 8192;

// Reads the head of a request (RFC 9112), up to and including its blank line. Returns the status of the answer: 200 for
// a GET with a path that a browser could send, otherwise 400 (malformed, no host or several), 405 (not a GET) or 505
// (not HTTP/1).
int read_request(std::string_view head, HttpRequest& request);

// The meaning of the status, for the first line of an answer.
std::string_view reason_of(int status);

}  // namespace carom
