const CONVENTIONS = {
    // The library's zero of the RX90L is V+'s own: home is 0, −90, 90, 0, 0, 0 in both.
    staubli_rx90l: { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] },
};
export const jointConvention = (robot) => CONVENTIONS[robot.id];
