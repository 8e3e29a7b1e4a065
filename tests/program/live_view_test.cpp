// carom view --live: the answers of its server to a browser, the refusal of all other requests, and a run followed to
// its end.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/view/http_request.hpp"
#include "app/view/live_run.hpp"
#include "app/view/loopback_server.hpp"
#include "core/base/check.hpp"
#include "io/files/output_folder.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(HttpRequest, IsReadAsTheStandardSays) {
  HttpRequest request;
  EXPECT_EQ(read_request("GET /a/b?c HTTP/1.1\r\nAccept: x\r\nhOsT:  here:1 \r\n\r\n", request), 200);
  EXPECT_EQ(request.path, "/a/b?c");
  EXPECT_EQ(request.host, "here:1");
  const std::string host = "\r\nHost: here\r\n\r\n";
  EXPECT_EQ(read_request("POST / HTTP/1.1" + host, request), 405);
  EXPECT_EQ(read_request("GET / HTTP/2.0" + host, request), 505);
  for (const std::string first : {"GET / ", "GET /", "GET http://here/ HTTP/1.1", "GET /a\tb HTTP/1.1", " / HTTP/1.1x",
                                  "GET /a b HTTP/1.1", "", "\r\n\r\n", "\x16\x03\x01"}) {
    EXPECT_NE(read_request(first + host, request), 200) << first;
  }
  EXPECT_EQ(read_request("GET / HTTP/1.1\r\n\r\n", request), 400) << "a request without a host";
  EXPECT_EQ(read_request("GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", request), 400) << "two hosts";
  EXPECT_EQ(read_request("GET / HTTP/1.1\r\nHost: a\r\nno colon\r\n\r\n", request), 400);
}

// A page or a movie reads a trajectory more than once, and must not read two different ones.
TEST(Recording, IsReadAsItWasFound) {
  const test::TestFolder folder("recording");
  const std::string frame =
      "1\nLattice=\"20 0 0 0 12 0 0 0 1\" pbc=\"F F F\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=0.5\nX 6 9 0 -2 0.5 0 1 1 0\n";
  const std::string name = folder.write("trajectory.xyz", frame);
  const Recording found = open_recording(name);
  TrajectoryFrame read;
  EXPECT_TRUE(open_frames(found)->read(read));
  std::ofstream(name, std::ios::app) << frame;  // the file may grow
  EXPECT_TRUE(open_frames(found)->read(read));
  std::filesystem::rename(folder.write("another.xyz", frame), name);
  EXPECT_THAT([&] { open_frames(found); }, testing::ThrowsMessage<InputError>(
                                               testing::StartsWith(name + ": was replaced while it was read; expec")));
}

// The socket of a browser or another client.
class Caller {
 public:
  explicit Caller(const std::string& link) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(link.c_str() + link.rfind(':') + 1)));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;
  ~Caller() { ::close(socket_); }

  void say(const std::string& text) const { ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT); }
  std::string hear() const {
    std::string text(1000, '\0');
    const ssize_t count = ::recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
  }
  // Closes the connection at once, with data still on their way.
  void vanish() const {
    const linger at_once{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  }

 private:
  int socket_;
};

class Loopback : public ::testing::Test {
 protected:
  Loopback() {
    const std::string& link = server_.link();  // has the form http://HOST/TOKEN/
    const std::size_t host = std::string("http://").size(), path = link.find('/', host);
    host_ = link.substr(host, path - host);
    path_ = link.substr(path);
  }
  std::string ask(const std::string& request) {
    const Caller caller(host_);
    caller.say(request);
    server_.serve(20);
    return caller.hear();
  }
  std::string get(const std::string& path, const std::string& host) {
    return ask("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  }
  void expect_alive() { EXPECT_THAT(get(path_ + "well", host_), HasSubstr("\r\n\r\nbehind: well")); }

  std::size_t body_ = 0;
  int asked_ = 0;
  LoopbackServer server_{[this](std::string_view path) {
    ++asked_;
    return HttpAnswer{200, "text/plain", body_ > 0 ? std::string(body_, 'x') : "behind: " + std::string(path)};
  }};
  std::string host_, path_;
};

TEST_F(Loopback, AnswersAtItsLink) {
  EXPECT_THAT(server_.link(), ::testing::MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/[0-9a-f]{32}/"));
  expect_alive();
  EXPECT_THAT(get(path_, "localhost" + host_.substr(host_.find(':'))), StartsWith("HTTP/1.1 200 "));
  LoopbackServer other([](std::string_view) { return HttpAnswer{}; });
  EXPECT_NE(other.link().substr(other.link().find('/', 8)), path_) << "each server has its own token";
}

TEST_F(Loopback, OtherHostsAndTokensGetNothing) {
  const std::string port = host_.substr(host_.find(':'));
  for (const std::string& host : {std::string("evil.example") + port, std::string("127.0.0.1"), "127.0.0.2" + port,
                                  host_ + "0", "[::1]" + port, std::string(), "evil." + host_, host_ + ".evil"}) {
    EXPECT_THAT(get(path_, host), StartsWith("HTTP/1.1 403 ")) << host;
  }
  const std::string token = path_.substr(1, 32);
  const std::string wrong = std::string(token[0] == 'a' ? "b" : "a") + token.substr(1);
  for (const std::string& path :
       {std::string("/"), std::string("//"), "/" + wrong + "/", "/" + token, "/" + token.substr(1) + "/",
        "/" + token + "0/", "//" + token + "/", "/../" + token + "/", "/?" + token + "/", "/x/../" + token + "/"}) {
    EXPECT_THAT(get(path, host_), StartsWith("HTTP/1.1 403 ")) << path;
  }
  EXPECT_THAT(ask("POST " + path_ + " HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n"), StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(ask("GET " + path_ + " HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_EQ(asked_, 0);
  expect_alive();
}

TEST_F(Loopback, SurvivesHalfRequestsEndlessOnesAndClientsThatGo) {
  const Caller silent(host_), half(host_);
  half.say("GET " + path_);
  { const Caller gone(host_); }
  {
    const Caller gone(host_);
    gone.say("GET / HT");
    gone.vanish();
  }
  expect_alive();
  const std::string filler = "\r\nX: " + std::string(longest_request, 'a') + "\r\n\r\n";
  const std::string long_head = ask("GET " + path_ + "well HTTP/1.1\r\nHost: " + host_ + filler);
  EXPECT_TRUE(long_head.empty() || long_head.starts_with("HTTP/1.1 431 ")) << long_head;
  half.say("well HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n");
  server_.serve(20);
  EXPECT_THAT(half.hear(), HasSubstr("behind: well"));
  const std::string endless = ask("GET /" + std::string(2 * longest_request, 'a'));
  EXPECT_TRUE(endless.empty() || endless.starts_with("HTTP/1.1 431 ")) << endless;
  body_ = 20'000'000;  // more than the system buffers at once
  {
    const Caller gone(host_);
    gone.say("GET " + path_ + " HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n");
    server_.serve(20);
    EXPECT_EQ(gone.hear().size(), 1000U);
    gone.vanish();
  }
  body_ = 0;
  server_.serve(20);
  expect_alive();
  EXPECT_GT(server_.quiet_seconds(), 0.0) << "no rest of the aborted answer may be pending";
}

TEST_F(Loopback, ManySilentClientsDoNotKeepOthersOut) {
  std::vector<std::unique_ptr<Caller>> silent;
  for (int k = 0; k < 40; ++k) silent.push_back(std::make_unique<Caller>(host_));
  server_.serve(30);
  expect_alive();
}

// Another loopback address of this computer stands for an address of its network.
TEST_F(Loopback, ListensAtOneAddressAlone) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(host_.c_str() + host_.find(':') + 1)));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_NE(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(socket);
}

// Frames of two disks, and of a third one from frame 3 on.
std::string frame_text(int k) {
  const int disks = k < 3 ? 2 : 3;
  std::string text = fmt::format(
      "{}\nLattice=\"8 0 0 0 6 0 0 0 1\" pbc=\"F F F\" "
      "Properties=species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 "
      "Time={}\n",
      disks, k);
  for (int i = 0; i < disks; ++i) text += fmt::format("X {} {} 0 0 0.5 1 {}\n", 1 + 2 * i, 1 + 0.25 * k, i);
  return text;
}

TEST(LiveRun, IsFollowedFrameByFrameToItsEnd) {
  const test::TestFolder folder("live");
  const auto path = folder.path() / "out";
  EXPECT_THROW(LiveRun(path, {}), InputError) << "there is no run yet";
  OutputFolder output(path, "scene.toml", false);
  std::ofstream file(output.path("trajectory.xyz"));
  const auto add = [&](const std::string& text) { file << text << std::flush; };
  add(frame_text(0));
  LiveRun live(path, {});
  const auto ask = [&](const std::string& what) { return live.answer(what); };
  const auto news = [&](const std::string& what) { return nlohmann::json::parse(live.answer(what).body); };
  EXPECT_THAT(ask("").body, HasSubstr("connect-src 'self'"));
  EXPECT_THAT(ask("").body, Not(HasSubstr("id=\"block0\"")));
  auto now = news("news/0/0");
  EXPECT_EQ(now["times"], (nlohmann::json{0.0}));
  EXPECT_EQ(now["id"], (nlohmann::json{0, 1}));
  add(frame_text(1) + frame_text(2) + frame_text(3).substr(0, 150));
  live.read(1.0);
  EXPECT_EQ(news("news/1/2")["times"], (nlohmann::json{1.0, 2.0})) << "a frame written in part does not count";
  add(frame_text(3).substr(150));
  live.read(1.0);
  now = news("news/2/2");
  EXPECT_EQ(now["times"], (nlohmann::json{3.0}));
  EXPECT_EQ(now["id"], (nlohmann::json{2}));
  EXPECT_EQ(now["ended"], false);
  EXPECT_EQ(ask("news/3/3").status, 200) << "there is nothing new for a page that has all";
  EXPECT_EQ(news("news/3/3")["times"], nlohmann::json::array());
  EXPECT_EQ(ask("block2").status, 200);
  EXPECT_EQ(ask("block2").body, ask("block2").body);
  for (const char* const path_outside :
       {"block3", "block", "block-1", "block1x", "block99999999999999999999", "news/9/0", "news/0", "news/0/", "news//",
        "news/0/0/", "../scene.toml", "scene.toml", "%2e%2e/scene.toml", "/etc/passwd", "trajectory.xyz", "?",
        "block0?"}) {
    EXPECT_EQ(ask(path_outside).status, 404) << path_outside;
    EXPECT_EQ(ask(path_outside).body, "") << path_outside;
  }
  add(frame_text(4));
  file.close();
  std::ofstream(output.path("summary.json")) << "{}";
  output.finish();
  live.read(0.0);  // no time for frames, but the last one is still read
  EXPECT_TRUE(live.ended());
  EXPECT_EQ(live.state(), "The run is done.");
  now = news("news/3/3");
  EXPECT_EQ(now["times"], (nlohmann::json{4.0}));
  EXPECT_EQ(now["ended"], true);
}

// Until its end a run that replaces an earlier one is in a folder beside the earlier results.
TEST(LiveRun, ThatIsStoppedIsNotTheEarlierOne) {
  const test::TestFolder folder("live_again");
  const auto path = folder.path() / "out";
  const auto all_times = [](const LiveRun& live) {
    return nlohmann::json::parse(live.answer("news/0/0").body)["times"];
  };
  {
    OutputFolder earlier(path, "scene.toml", false);
    std::ofstream(earlier.path("trajectory.xyz")) << frame_text(10) << frame_text(11) << frame_text(12);
    std::ofstream(earlier.path("summary.json")) << "{}";
    earlier.finish();
  }
  for (const bool kept : {true, false}) {
    std::optional<OutputFolder> output(std::in_place, path, "scene.toml", true);
    std::ofstream(output->path("trajectory.xyz")) << frame_text(0) << frame_text(1);
    LiveRun live(path, {});
    if (kept) output->keep_unfinished();
    output.reset();
    live.read(1.0);
    EXPECT_TRUE(live.ended());
    EXPECT_EQ(live.state(), "The run has stopped.");
    EXPECT_EQ(all_times(live), (nlohmann::json{0.0, 1.0})) << (kept ? "kept" : "taken away");
  }
}

TEST(LiveRun, ItsSeriesGrowsWithTheRun) {
  const test::TestFolder folder("live_series");
  const auto path = folder.path() / "out";
  OutputFolder output(path, "scene.toml", false);
  std::ofstream(output.path("trajectory.xyz")) << frame_text(0) << frame_text(1);
  std::ofstream series(output.path("series.csv"));
  series << "t,kinetic\n0,2.5\n" << std::flush;
  LiveRun live(path, {});
  const auto columns = [&] { return nlohmann::json::parse(live.answer("news/0/0").body)["series"]["columns"]; };
  live.read(1.0);
  EXPECT_EQ(columns(), (nlohmann::json{{0.0}, {2.5}}));
  series << "1,3.5\n" << std::flush;
  live.read(1.0);
  EXPECT_EQ(columns(), (nlohmann::json{{0.0, 1.0}, {2.5, 3.5}}));
}

TEST(LiveRun, KeepsThePageBelowItsSize) {
  const test::TestFolder folder("full");
  const auto path = folder.path() / "out";
  OutputFolder output(path, "scene.toml", false);
  std::ofstream file(output.path("trajectory.xyz"));
  file << frame_text(0) << std::flush;
  ViewSettings settings;
  settings.most_bytes = 4000;
  LiveRun live(path, settings);
  for (int k = 1; k < 400; ++k) {
    file << frame_text(k) << std::flush;
    live.read(1.0);
  }
  const auto all = nlohmann::json::parse(live.answer("news/0/0").body);
  std::size_t bytes = 0;
  for (std::size_t b = 0; b < all["blocks"].size(); ++b) bytes += live.answer(fmt::format("block{}", b)).body.size();
  EXPECT_LE(bytes, 4000U);
  EXPECT_GT(bytes, 2000U);
  EXPECT_THAT(live.state(), HasSubstr("on, the page shows one frame of up to "));
  const auto times = all["times"].get<std::vector<double>>();
  ASSERT_GT(times.size(), 3U);
  EXPECT_EQ(times[1] - times[0], 1.0);
  EXPECT_GE(times[times.size() - 1] - times[times.size() - 2], 2.0) << "of several frames one is shown";
}

}  // namespace
}  // namespace carom
