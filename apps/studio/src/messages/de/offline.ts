/** Öffnen ohne Netz, und neuere Fassungen. */
export const offline = {
  ready: "Eine neuere Fassung von Twincell ist da. Die Zellen bleiben.",
  take: "Jetzt verwenden",
  later: "Später",
  noWorker: "Diese Seite lässt sich nicht für den Betrieb ohne Netz behalten: über https oder auf localhost öffnen.",
  "notKept(why)": "Diese Seite wird nicht für den Betrieb ohne Netz behalten: {why}",
};
