// A server only for browsers on this computer, and of these only for those that have its link.
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

// Listens on 127.0.0.1 at a port that the system chooses. All its answers are behind a token of 128 random bits; a
// request that names another host (from a page elsewhere whose name was made to lead here), another token or another
// method than GET gets an answer without content. One request a connection, of at most longest_request bytes; a
// connection has ten seconds to send it. Each time, only as much is sent as the system's buffer takes, so a slow
// connection does not delay others.
class LoopbackServer {
 public:
  // path: the part behind the token, such as "" or "block3".
  using Answer = std::function<HttpAnswer(std::string_view path)>;

  // Throws RunError if the system refuses a socket.
  explicit LoopbackServer(Answer answer);
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;
  ~LoopbackServer();

  const std::string& link() const { return link_; }  // http://127.0.0.1:PORT/TOKEN/

  // Waits for requests and answers them, for this number of milliseconds.
  void serve(int milliseconds);

  // Seconds since the last request with the token, or since the beginning; 0 while one is being answered.
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
