/** Programs on top of ROS-Industrial's own simple_message library: every byte of them is its doing. */

/** Of its src folder. */
export const SOURCES = [
  "byte_array.cpp",
  "simple_message.cpp",
  "smpl_msg_connection.cpp",
  "socket/simple_socket.cpp",
  "socket/tcp_client.cpp",
  "socket/tcp_socket.cpp",
  "socket/tcp_server.cpp",
  "joint_data.cpp",
  "joint_traj_pt.cpp",
  "robot_status.cpp",
  "messages/joint_message.cpp",
  "messages/joint_traj_pt_message.cpp",
  "messages/robot_status_message.cpp",
];
/** Its server listens on every address of the machine; here it is to be seen by this machine only. */
export const LOOPBACK = `#include <netinet/in.h>
#include <cstdint>
#undef INADDR_ANY
#define INADDR_ANY htonl(INADDR_LOOPBACK)
`;
const HEAD = `#include "simple_message/simple_message.h"
#include "simple_message/socket/tcp_client.h"
#include "simple_message/socket/tcp_server.h"
#include "simple_message/messages/joint_message.h"
#include "simple_message/messages/joint_traj_pt_message.h"
#include "simple_message/messages/robot_status_message.h"
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <chrono>
#include <mutex>
using namespace industrial;
using simple_message::SimpleMessage;
`;

/** ADDRESS MOTION FEEDBACK Q…: a point there, one beyond every limit, what the feedback says, a stop. */
export const CLIENT = `${HEAD}
static int ask(tcp_client::TcpClient &to, int sequence, joint_data::JointData &q, float velocity) {
  joint_traj_pt::JointTrajPt point;
  point.init(sequence, q, velocity, 1.0);
  joint_traj_pt_message::JointTrajPtMessage message;
  message.init(point);
  SimpleMessage request, reply;
  message.toRequest(request);
  if (!to.sendAndReceiveMsg(request, reply)) return -1;
  return reply.getReplyCode();
}
int main(int, char **args) {
  tcp_client::TcpClient motion, feedback;
  if (!feedback.init(args[1], atoi(args[3])) || !feedback.makeConnect() || !motion.init(args[1], atoi(args[2])) || !motion.makeConnect()) return 2;
  SimpleMessage message;
  if (!feedback.receiveMsg(message)) return 3;
  joint_data::JointData q, wide, none;
  for (int i = 0; i < 6; i++) { q.setJoint(i, atof(args[4 + i])); wide.setJoint(i, 9.0); }
  printf("point 7: reply %d\\n", ask(motion, 7, q, 1.0));
  printf("beyond: reply %d\\n", ask(motion, 8, wide, 1.0));
  joint_data::JointData is;
  bool hasStatus = false;
  for (int i = 0; i < 400; i++) {
    if (!feedback.receiveMsg(message)) return 4;
    if (message.getMessageType() == 10) {
      joint_message::JointMessage joints;
      joints.init(message);
      is.copyFrom(joints.getJoints());
      float far = 0;
      for (int k = 0; k < 6; k++) far = std::max(far, std::fabs(is.getJoint(k) - q.getJoint(k)));
      if (hasStatus && far < 1e-5) break;
    } else if (message.getMessageType() == 13) {
      robot_status_message::RobotStatusMessage said;
      said.init(message);
      robot_status::RobotStatus &s = said.status_;
      if (!hasStatus) printf("status: powered %d emergency %d error %d mode %d possible %d\\n", s.getDrivesPowered(), s.getEStopped(), s.getErrorCode(), s.getMode(), s.getMotionPossible());
      hasStatus = true;
    }
  }
  printf("joints:");
  for (int k = 0; k < 6; k++) printf(" %.9g", is.getJoint(k));
  printf("\\nstop: reply %d\\n", ask(motion, -4, none, 0.0));
  return 0;
}
`;

/** MOTION FEEDBACK: an arm that goes to each point in a straight line of joints, with ros_server's states. */
export const SERVER = `${HEAD}
static std::mutex guard;
static float at[10], to[10];
int main(int, char **args) {
  tcp_server::TcpServer motion, feedback;
  if (!motion.init(atoi(args[1])) || !feedback.init(atoi(args[2]))) return 2;
  if (!feedback.makeConnect() || !motion.makeConnect()) return 3;
  std::thread([&motion]() {
    SimpleMessage request, reply;
    while (motion.receiveMsg(request)) {
      joint_traj_pt_message::JointTrajPtMessage message;
      message.init(request);
      joint_data::JointData q;
      message.point_.getJointPosition(q);
      { std::lock_guard<std::mutex> lock(guard); for (int i = 0; i < 10; i++) to[i] = message.point_.getSequence() == -4 ? at[i] : q.getJoint(i); }
      message.toReply(reply, simple_message::ReplyTypes::SUCCESS);
      if (!motion.sendMsg(reply)) break;
    }
  }).detach();
  for (int count = 0; ; count++) {
    bool moving = false;
    joint_data::JointData q;
    {
      std::lock_guard<std::mutex> lock(guard);
      for (int i = 0; i < 10; i++) {
        float step = to[i] - at[i];
        moving = moving || step != 0;
        at[i] = std::fabs(step) < 0.03f ? to[i] : at[i] + std::copysign(0.03f, step);
        q.setJoint(i, at[i]);
      }
    }
    joint_message::JointMessage joints;
    joints.init(0, q);
    SimpleMessage message;
    joints.toTopic(message);
    if (!feedback.sendMsg(message)) return 0;
    if (count % 5 == 4) {
      robot_status::RobotStatus status;
      status.init(robot_status::TriStates::TS_TRUE, robot_status::TriStates::TS_FALSE, 0, robot_status::TriStates::TS_FALSE, moving ? robot_status::TriStates::TS_TRUE : robot_status::TriStates::TS_FALSE, robot_status::RobotModes::AUTO, robot_status::TriStates::TS_TRUE);
      robot_status_message::RobotStatusMessage said;
      said.init(status);
      said.toTopic(message);
      if (!feedback.sendMsg(message)) return 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}
`;
