const CONVENTIONS = {
    // The library turns the axes as the controller shows them; U is level at 0 with the upper arm upright.
    yaskawa_gp8: { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] },
};
export const axisConvention = (robot) => Object.hasOwn(CONVENTIONS, robot.id) ? CONVENTIONS[robot.id] : undefined;
/** Of the virtual GP8 only: the size is that of the class, the digits are made up. A real robot has its own. */
export const EXAMPLE_PULSES = {
    yaskawa_gp8: { pulsesPerDegree: [1340, 1340, 1340, 1000, 1000, 620], source: "example" },
};
