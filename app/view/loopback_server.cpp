#include "app/view/loopback_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "app/view/http_request.hpp"
#include "core/base/check.hpp"

namespace carom {

namespace {

constexpr std::size_t most_clients = 64;
constexpr double patience = 10.0;        // seconds for a request
constexpr double long_patience = 300.0;  // seconds for a whole answer

[[noreturn]] void fail(const char* what) {
  throw RunError(fmt::format("--live: cannot {}: {}", what, std::strerror(errno)));
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getentropy(bytes.data(), bytes.size()) != 0) fail("get random numbers");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

// Takes the same time for any two texts of the same length, so that the time reveals nothing about a token.
bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k]));
  }
  return difference == 0;
}

// Other pages may neither embed nor read the answer, and it is not stored anywhere.
std::string text_of(const HttpAnswer& answer) {
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\nCache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\n\r\n{}",
      answer.status, reason_of(answer.status), answer.type, answer.body.size(), answer.body);
}

bool will_come_again() {
  return errno == EAGAIN || errno == EINTR;
}

}  // namespace

LoopbackServer::LoopbackServer(Answer answer)
    : answer_(std::move(answer)), token_(random_token()), last_(WallClock::now()) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) fail("open a socket");
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(socket_, any, length) != 0 || ::listen(socket_, SOMAXCONN) != 0 ||
      ::getsockname(socket_, any, &length) != 0) {
    const int why = errno;
    ::close(socket_);
    errno = why;
    fail("listen on the loopback address");
  }
  host_ = fmt::format("127.0.0.1:{}", ntohs(address.sin_port));
  local_host_ = fmt::format("localhost:{}", ntohs(address.sin_port));
  link_ = fmt::format("http://{}/{}/", host_, token_);
}

LoopbackServer::~LoopbackServer() {
  for (const Client& client : clients_) ::close(client.socket);
  ::close(socket_);
}

double LoopbackServer::quiet_seconds() const {
  const bool answering =
      std::any_of(clients_.begin(), clients_.end(), [](const Client& client) { return !client.answer.empty(); });
  return answering ? 0.0 : seconds_since(last_);
}

std::string LoopbackServer::answer_to(std::string_view head) {
  HttpRequest request;
  HttpAnswer answer;
  answer.status = read_request(head, request);
  if (answer.status != 200) return text_of(answer);
  answer.status = 403;
  if (request.host != host_ && request.host != local_host_) return text_of(answer);
  const std::string_view path = std::string_view(request.path).substr(1);
  const std::size_t end = std::min(path.find('/'), path.size());
  if (end == path.size() || !same_token(path.substr(0, end), token_)) return text_of(answer);
  last_ = WallClock::now();
  return text_of(answer_(path.substr(end + 1)));
}

void LoopbackServer::accept_one() {
  const int socket = ::accept4(socket_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (socket < 0) return;
  clients_.push_back({socket, "", "", 0, WallClock::now()});
}

void LoopbackServer::read_from(Client& client) {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::recv(client.socket, bytes.data(), bytes.size(), 0);
  if (count < 0 && will_come_again()) return;
  if (count <= 0) {  // the client went away before its request
    ::close(std::exchange(client.socket, -1));
    return;
  }
  client.request.append(bytes.data(), static_cast<std::size_t>(count));
  const std::size_t end = client.request.find("\r\n\r\n");
  if (end == std::string::npos && client.request.size() <= longest_request) return;
  const bool too_long = end > longest_request;  // or it has no end yet
  client.answer = too_long ? text_of({431, "text/plain", ""}) : answer_to(client.request.substr(0, end + 4));
  client.since = WallClock::now();
  write_to(client);
}

void LoopbackServer::write_to(Client& client) const {
  while (client.sent < client.answer.size()) {
    const ssize_t count =
        ::send(client.socket, client.answer.data() + client.sent, client.answer.size() - client.sent, MSG_NOSIGNAL);
    if (count < 0 && will_come_again()) return;
    if (count <= 0) break;  // the client went away
    client.sent += static_cast<std::size_t>(count);
  }
  ::shutdown(client.socket, SHUT_WR);
  ::close(std::exchange(client.socket, -1));
}

void LoopbackServer::drop_finished() {
  for (Client& client : clients_) {
    const bool late = seconds_since(client.since) > (client.answer.empty() ? patience : long_patience);
    if (client.socket >= 0 && late) ::close(std::exchange(client.socket, -1));
  }
  std::erase_if(clients_, [](const Client& client) { return client.socket < 0; });
}

void LoopbackServer::serve(int milliseconds) {
  const auto start = WallClock::now();
  for (int left = milliseconds; left > 0; left = milliseconds - static_cast<int>(1000.0 * seconds_since(start))) {
    std::vector<pollfd> waiting;
    for (const Client& client : clients_) {
      waiting.push_back({client.socket, static_cast<short>(client.answer.empty() ? POLLIN : POLLOUT), 0});
    }
    if (clients_.size() < most_clients) waiting.push_back({socket_, POLLIN, 0});
    if (::poll(waiting.data(), waiting.size(), left) < 0 && errno != EINTR) fail("wait for requests");
    const std::size_t known = clients_.size();
    for (std::size_t k = 0; k < known; ++k) {
      if (waiting[k].revents == 0) continue;
      Client& client = clients_[k];
      if (client.answer.empty()) {
        read_from(client);
      } else {
        write_to(client);
      }
    }
    if (waiting.size() > known && waiting[known].revents != 0) accept_one();
    drop_finished();
  }
}

}  // namespace carom
