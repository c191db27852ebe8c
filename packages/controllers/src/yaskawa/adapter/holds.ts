import { COMMAND, OFF, ON, POWER, RESET, SERVICE, word } from "../codec/index.ts";
import type { Answer, Client, Question } from "./client.ts";

/** Switches do no harm when they are said again [s]. */
const PATIENCE_S = [0.1, 0.3, 0.5, 1];
const order = (command: number, instance: number, value: number): Omit<Question, "patience_s"> => ({
  command,
  instance,
  attribute: 1,
  service: SERVICE.setOne,
  data: word(value),
});

const HOLD = order(COMMAND.power, POWER.hold, ON);
const SERVO_OFF = order(COMMAND.power, POWER.servo, OFF);

/** Goes out beside whatever waits for its answer. */
export const holdOn = (client: Client): Promise<Answer> =>
  client.ask({ ...HOLD, urgent: true, patience_s: PATIENCE_S });
export const holdOff = (client: Client): Promise<Answer> =>
  client.ask({ ...order(COMMAND.power, POWER.hold, OFF), patience_s: PATIENCE_S });
export const servoOff = (client: Client): Promise<Answer> =>
  client.ask({ ...SERVO_OFF, urgent: true, patience_s: PATIENCE_S });
export const servoOn = (client: Client): Promise<Answer> =>
  client.ask({ ...order(COMMAND.power, POWER.servo, ON), patience_s: PATIENCE_S });
export const resetAlarm = (client: Client): Promise<Answer> =>
  client.ask({ ...order(COMMAND.reset, RESET.alarm, ON), patience_s: PATIENCE_S });
export const cancelError = (client: Client): Promise<Answer> =>
  client.ask({ ...order(COMMAND.reset, RESET.error, ON), patience_s: PATIENCE_S });
/** The last words of a line that is given up; nobody waits for an answer. */
export const sayHold = (client: Client): void => {
  client.say(HOLD);
};
export const saySevered = (client: Client): void => {
  client.say(HOLD);
  client.say(SERVO_OFF);
};
