/**
 * Programs on top of the Rx90 class of luismarzo/rx90, which moves a real RX90 by the monitor of V+: its serial port is
 * a socket here.
 */

/** What the class uses of LibSerial: a stream of characters that is opened by a name, here `ADDRESS:PORT`. */
export const SERIAL_STREAM = `#pragma once
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cstdlib>
#include <sstream>
#include <string>
namespace LibSerial {
struct SerialStreamBuf { enum { BAUD_9600, PARITY_NONE, CHAR_SIZE_8, FLOW_CONTROL_NONE }; };
class SerialStream {
  int line = -1;
public:
  void Open(const char *name) {
    std::string at(name);
    std::size_t colon = at.find(':');
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(std::atoi(at.substr(colon + 1).c_str()));
    inet_pton(AF_INET, at.substr(0, colon).c_str(), &to.sin_addr);
    line = socket(AF_INET, SOCK_STREAM, 0);
    if (connect(line, (sockaddr *)&to, sizeof to) != 0) std::exit(2);
  }
  void Close() { close(line); line = -1; }
  bool IsOpen() const { return line >= 0; }
  void SetBaudRate(int) {} void SetParity(int) {} void SetCharSize(int) {} void SetFlowControl(int) {} void SetNumOfStopBits(int) {}
  void unsetf(std::ios_base::fmtflags) {}
  template <typename T> SerialStream &operator<<(const T &what) {
    std::ostringstream text;
    text << what;
    if (write(line, text.str().data(), text.str().size()) < 0) std::exit(3);
    return *this;
  }
  SerialStream &operator>>(char &sign) { if (read(line, &sign, 1) != 1) std::exit(4); return *this; }
};
}
`;
/** ADDRESS:PORT ORIGIN: the class sets itself up, then closes the hand. */
export const RX90_MAIN = `#include "Rx90.h"
int main(int, char **args) {
  Rx90 robot(args[1], args[2]);
  robot.move(Rx90::CATCH);
  return 0;
}
`;
