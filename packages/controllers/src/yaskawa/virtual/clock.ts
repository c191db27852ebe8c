const DAY_S = 86_400;
/**
 * Days of 400 years, of a century, of four years, of a year; of the days before 1970 counted from 1 March of the year
 * 0.
 */
const ERA = 146_097;
const BEFORE_1970 = 719_468;

const two = (value: number): string => String(value).padStart(2, "0");

/** `YYYY/MM/DD hh:mm` of seconds since 1970. Years begin in March here, so that the odd day is the last one. */
export function stamp(unix_s: number): string {
  const days = Math.floor(unix_s / DAY_S);
  const second = unix_s - days * DAY_S;
  const from = days + BEFORE_1970;
  const era = Math.floor(from / ERA);
  const ofEra = from - era * ERA;
  const year = Math.floor(
    (ofEra - Math.floor(ofEra / 1460) + Math.floor(ofEra / 36_524) - Math.floor(ofEra / 146_096)) / 365,
  );
  const ofYear = ofEra - (365 * year + Math.floor(year / 4) - Math.floor(year / 100));
  const march = Math.floor((5 * ofYear + 2) / 153);
  const day = ofYear - Math.floor((153 * march + 2) / 5) + 1;
  const month = march < 10 ? march + 3 : march - 9;
  return `${year + 400 * era + (month <= 2 ? 1 : 0)}/${two(month)}/${two(day)} ${two(Math.floor(second / 3600))}:${two(Math.floor(second / 60) % 60)}`;
}

/** `hhhhhh:mm'ss`. */
export function elapsed(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${String(Math.floor(whole / 3600)).padStart(6, "0")}:${two(Math.floor(whole / 60) % 60)}'${two(whole % 60)}`;
}
