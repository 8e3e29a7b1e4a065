// A server for browsers on this computer alone, and of these for those that have its link.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/wall_clock.hpp"

namespace carom {

struct HttpAnswer {
  int status = 404;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

// Listens on 127.0.0.1 at a port that the system chooses. Everything it answers lies behind a token of 128 random bits;
// what names another host (a page elsewhere whose name was made to lead here), another token or another method than GET
// gets an answer without content. One request a connection, of at most longest_request bytes; a connection has ten
// seconds to send it, and the system's buffer to take what it can each time: a slow one holds up no other.
class LoopbackServer {
 public:
  // path: behind the token, such as "" or "block3".
  using Answer = std::function<HttpAnswer(std::string_view path)>;

  // Throws RunError where the system refuses a socket.
  explicit LoopbackServer(Answer answer);
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;
  ~LoopbackServer();

  const std::string& link() const { return link_; }  // http://127.0.0.1:PORT/TOKEN/

  // Waits for requests and answers them, for so many milliseconds.
  void serve(int milliseconds);

  // Seconds since a request with the token came, or since the beginning; 0 while one is being answered.
  double quiet_seconds() const;

 private:
  struct Client {
    int socket = -1;
    std::string request, answer;
    std::size_t sent = 0;
    WallClock::time_point since;
  };

  void accept_one();
  void read_from(Client& client);
  void write_to(Client& client) const;
  void drop_finished();
  std::string answer_to(std::string_view head);

  Answer answer_;
  int socket_ = -1;
  std::string token_, link_, host_, local_host_;
  std::vector<Client> clients_;
  WallClock::time_point last_;
};

}  // namespace carom
