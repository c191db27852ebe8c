/**
 * The program that runs on the robot while it is driven move by move, in the controller's own language. Registers 24
 * and up are those for clients of RTDE. It stops by itself when the heartbeat stays away: the robot's own watchdog, not
 * ours.
 *
 *   input int 24     heartbeat, written again and again
 *   input int 25     number of the order; a new one begins it
 *   input int 26     what is ordered: see ORDERS
 *   input double 24  joints [rad] or flange pose of the target, six
 *   input double 30  flange pose of the point on an arc, six
 *   input double 36  speed [rad/s or m/s]; 37 acceleration [rad/s² or m/s²]
 *   output int 24    number of the order that has ended
 *   output int 25    LISTENING while the program takes orders
 */
export const ORDERS = { joints: 1, line: 2, arc: 3, stop: 4, payload: 5 } as const;
export const REGISTERS = {
  heartbeat: 24,
  order: 25,
  what: 26,
  target: 24,
  via: 30,
  speed: 36,
  acceleration: 37,
  ended: 24,
  listening: 25,
} as const;
/** Says which program it is, and which protocol of registers it speaks. */
export const LISTENING = 20_261;
/** Fewer heartbeats than this, and the robot stops [Hz]; and how soon that is [s]. */
const LEAST_HZ = 12.5;
export const WATCHDOG_S = 1 / LEAST_HZ;
/** How a stop slows down [rad/s²]. */
const STOP_RAD_S2 = 4;

const { heartbeat, order, what, target, via, speed, acceleration, ended, listening } = REGISTERS;

export const CONTROL_PROGRAM = `def twincell():
  global order = read_input_integer_register(${order})
  global mover = 0
  def numbers(first):
    local all = [0, 0, 0, 0, 0, 0]
    local i = 0
    while i < 6:
      all[i] = read_input_float_register(first + i)
      i = i + 1
    end
    return all
  end
  def place(first):
    local all = numbers(first)
    return p[all[0], all[1], all[2], all[3], all[4], all[5]]
  end
  thread travel():
    local kind = read_input_integer_register(${what})
    local speed = read_input_float_register(${speed})
    local acceleration = read_input_float_register(${acceleration})
    if kind == ${ORDERS.joints}:
      movej(numbers(${target}), a=acceleration, v=speed)
    elif kind == ${ORDERS.line}:
      movel(place(${target}), a=acceleration, v=speed)
    elif kind == ${ORDERS.arc}:
      movec(place(${via}), place(${target}), a=acceleration, v=speed)
    end
    enter_critical
    mover = 0
    write_output_integer_register(${ended}, order)
    exit_critical
  end
  set_tcp(p[0, 0, 0, 0, 0, 0])
  rtde_set_watchdog("input_int_register_${heartbeat}", ${LEAST_HZ}, "stop")
  write_output_integer_register(${ended}, order)
  write_output_integer_register(${listening}, ${LISTENING})
  while True:
    if read_input_integer_register(${order}) != order:
      order = read_input_integer_register(${order})
      if mover != 0:
        kill mover
        mover = 0
      end
      if read_input_integer_register(${what}) == ${ORDERS.stop}:
        stopj(${STOP_RAD_S2})
        write_output_integer_register(${ended}, order)
      elif read_input_integer_register(${what}) == ${ORDERS.payload}:
        set_payload(read_input_float_register(${target}), [read_input_float_register(${target + 1}), read_input_float_register(${target + 2}), read_input_float_register(${target + 3})])
        write_output_integer_register(${ended}, order)
      else:
        mover = run travel()
      end
    end
    sync()
  end
end
`;
