#include "io/link/uri.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace godwit::io::link {
namespace uri_test {

using kind = uri::kind;

uri network(kind which, std::string host, std::uint16_t port) {
  return {.which = which, .host = std::move(host), .port = port, .device = {}, .baud = 0};
}

uri serial(std::string device, std::uint32_t baud) {
  return {.which = kind::serial, .host = {}, .port = 0, .device = std::move(device), .baud = baud};
}

TEST(link_uri, every_form_is_read) {
  const std::pair<const char*, uri> forms[] = {
      {"udpin://127.0.0.1:14550", network(kind::udp_in, "127.0.0.1", 14550)},
      {"udpin://0.0.0.0:0", network(kind::udp_in, "0.0.0.0", 0)},
      {"udpin://:14550", network(kind::udp_in, "", 14550)},
      {"udp://:14540", network(kind::udp_in, "", 14540)},
      {"udp://[::1]:14540", network(kind::udp_in, "::1", 14540)},
      {"udpout://gcs.example.org:14550", network(kind::udp_out, "gcs.example.org", 14550)},
      {"udpout://[fe80::1%eth0]:14550", network(kind::udp_out, "fe80::1%eth0", 14550)},
      {"tcp://localhost:5760", network(kind::tcp, "localhost", 5760)},
      {"tcp://[2001:db8::7]:65535", network(kind::tcp, "2001:db8::7", 65535)},
      {"tcpin://127.0.0.1:5760", network(kind::tcp_in, "127.0.0.1", 5760)},
      {"tcpin://:0", network(kind::tcp_in, "", 0)},
      {"serial:///dev/ttyAMA0:921600", serial("/dev/ttyAMA0", 921600)},
      {"serial:///dev/ttyACM0", serial("/dev/ttyACM0", 57600)},
      {"serial:///dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0",
       serial("/dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0", 57600)},
      {"serial:///dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0:115200",
       serial("/dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0", 115200)},
  };
  for (const auto& [text, expected] : forms) {
    const auto read = parse_uri(text);
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(*read, expected) << text;
    EXPECT_EQ(parse_uri(read->text()).value(), *read) << text;
  }
}

TEST(link_uri, a_mistake_is_named_and_the_forms_are_shown) {
  const std::pair<std::string, const char*> mistakes[] = {
      {"", "the kind of link is missing"},
      {"/dev/ttyACM0", "the kind of link is missing"},
      {"udp:127.0.0.1:14550", "the kind of link is missing"},
      {"serial:/dev/ttyACM0:57600", "the kind of link is missing"},
      {"UDP://127.0.0.1:14550", "kind of link \"UDP\" is not known"},
      {"tcpout://127.0.0.1:5760", "kind of link \"tcpout\" is not known"},
      {"://127.0.0.1:14550", "kind of link \"\" is not known"},
      {"udpin://", "the port is missing"},
      {"udpin://127.0.0.1", "the port is missing"},
      {"udpin://127.0.0.1:", "port \"\" is not a number from 0 to 65535"},
      {"udpin://127.0.0.1:65536", "port \"65536\" is not a number from 0 to 65535"},
      {"udpout://127.0.0.1:0", "port \"0\" is not a number from 1 to 65535"},
      {"tcp://127.0.0.1:-1", "port \"-1\" is not a number"},
      {"tcp://127.0.0.1:5760/", "port \"5760/\" is not a number"},
      {"tcp://127.0.0.1: 5760", "port \" 5760\" is not a number"},
      {"tcp://127.0.0.1:5760:2", "port \"5760:2\" is not a number"},
      {"tcp://127.0.0.1:99999999999999999999", "is not a number"},
      {"udpout://:14550", "the host is missing"},
      {"tcp://:5760", "the host is missing"},
      {"udpin://300.1.2.3:14550", "host \"300.1.2.3\" is not an IPv4 address"},
      {"udpin://127.1:14550", "host \"127.1\" is not an IPv4 address"},
      {"udpout://my host:14550", "host \"my host\" is neither a name nor an address"},
      {"udpout://user@host:14550", "host \"user@host\" is neither"},
      {"udpout://::1:14550", "stands in brackets"},
      {"udpout://[::1:14550", "bracket of the IPv6 address is not closed"},
      {"udpout://[::1]", "the port is missing"},
      {"udpout://[::1]14550", "the port is missing"},
      {"udpout://[]:14550", "host \"\" in brackets is not an IPv6 address"},
      {"udpout://[1.2.3.4]:14550", "in brackets is not an IPv6 address"},
      {"udpout://[fe80::1%]:14550", "in brackets is not an IPv6 address"},
      {"serial://", "device \"\" is not an absolute path"},
      {"serial://ttyACM0:57600", "device \"ttyACM0:57600\" is not an absolute path"},
      {"serial:///", "device \"/\" is not the name of a device"},
      {"serial:///dev/", "device \"/dev/\" is not the name of a device"},
      {"serial:///dev/tty\nACM0", "device \"/dev/tty?ACM0\" is not the name of a device"},
      {"serial:///dev/ttyACM0:", "baud rate \"\" is not a number from 300 to 12000000"},
      {"serial:///dev/ttyACM0:fast", "baud rate \"fast\" is not a number"},
      {"serial:///dev/ttyACM0:299", "baud rate \"299\" is not a number from 300"},
      {"serial:///dev/ttyACM0:57600,8N1", "baud rate \"57600,8N1\" is not a number"},
      {"udpin://" + std::string(600, 'a') + ":1", "longer than 512 characters"},
  };
  for (const auto& [text, part] : mistakes) {
    const auto read = parse_uri(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().find(part), std::string::npos) << read.error();
    for (const char* form : {"udpin://HOST:PORT", "serial:///dev/NAME:BAUD", "tcp://HOST:PORT", "tcpin://HOST:PORT"})
      EXPECT_NE(read.error().find(form), std::string::npos) << read.error();
    EXPECT_LT(read.error().size(), 400U) << "a mistake is quoted in part only";
  }
}

TEST(link_uri, udpin_and_tcpin_listen) {
  for (const char* text : {"udpin://:1", "udp://:1", "tcpin://:1"})
    EXPECT_TRUE(parse_uri(text)->listens()) << text;
  for (const char* text : {"udpout://a:1", "tcp://a:1", "serial:///dev/ttyACM0"})
    EXPECT_FALSE(parse_uri(text)->listens()) << text;
}

RC_GTEST_PROP(link_uri_property, what_is_read_is_written_the_same_way, ()) {
  const auto head =
      *rc::gen::element<std::string>("udp://", "udpin://", "udpout://", "tcp://", "tcpin://", "serial://", "");
  const auto tail =
      *rc::gen::container<std::string>(rc::gen::element('[', ']', ':', '/', '.', '%', '1', '0', 'f', 'x'));
  const auto read = parse_uri(head + tail);
  const auto again = read ? parse_uri(read->text()) : read;
  RC_ASSERT(again.has_value() == read.has_value());
  if (read)
    RC_ASSERT(again.value() == read.value());
  else
    RC_ASSERT(!read.error().empty());
}

} // namespace uri_test
} // namespace godwit::io::link
