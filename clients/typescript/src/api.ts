// Written by `node scripts/write-client.mjs` from the schemas of the server. Do not edit.

/** What became of a command. */
export type Outcome =
  | {
      readonly kind: "done";
    }
  | {
      readonly kind: "refused";
      readonly why: {
        readonly code: string;
        readonly sentence: string;
        readonly hint: string;
        readonly joint?: number;
        readonly value?: number;
        readonly limit?: number;
      };
    }
  | {
      readonly kind: "stopped";
      readonly why: {
        readonly code: string;
        readonly sentence: string;
        readonly hint: string;
        readonly joint?: number;
        readonly value?: number;
        readonly limit?: number;
      };
    };

/** What each address of the API is asked and answers. SI units and radians; joints count from 1. */
export interface Routes {
  /** This API for people */
  readonly apiPage: {
    readonly method: "GET";
    readonly path: "/api";
    readonly body: undefined;
    readonly answer: string;
  };
  /** OpenAPI 3.1 document of the HTTP part */
  readonly openapi: {
    readonly method: "GET";
    readonly path: "/api/openapi.json";
    readonly body: undefined;
    readonly answer: Readonly<Record<string, unknown>>;
  };
  /** AsyncAPI 3.0 document of the sockets */
  readonly asyncapi: {
    readonly method: "GET";
    readonly path: "/api/asyncapi.json";
    readonly body: undefined;
    readonly answer: Readonly<Record<string, unknown>>;
  };
  /** The process answers */
  readonly healthz: {
    readonly method: "GET";
    readonly path: "/healthz";
    readonly body: undefined;
    readonly answer: string;
  };
  /** Whether requests are taken: 503 while the server closes */
  readonly readyz: {
    readonly method: "GET";
    readonly path: "/readyz";
    readonly body: undefined;
    readonly answer: {
      readonly ready: boolean;
      readonly robots: number;
      readonly connected: number;
    };
  };
  /** Figures for Prometheus */
  readonly metrics: {
    readonly method: "GET";
    readonly path: "/metrics";
    readonly body: undefined;
    readonly answer: string;
  };
  /** Versions and documents */
  readonly about: {
    readonly method: "GET";
    readonly path: "/api/v1";
    readonly body: undefined;
    readonly answer: {
      readonly name: "twincell";
      readonly version: string;
      readonly api: number;
      readonly protocol: number;
      readonly openapi: string;
      readonly asyncapi: string;
    };
  };
  /** Who is signed in, and whether people sign in here */
  readonly session: {
    readonly method: "GET";
    readonly path: "/api/v1/session";
    readonly body: undefined;
    readonly answer: {
      /** Whether people sign in by name here. */
      readonly accounts: boolean;
      /** Who is signed in. */
      readonly name: unknown;
      readonly role: "viewer" | "programmer" | "operator" | "admin" | null;
      /** Another role for single robots and cells, by id or name. */
      readonly rights: Readonly<Record<string, "viewer" | "programmer" | "operator" | "admin">>;
      readonly passkeys: number;
      /** Name of the cell that a read-only link lets in to; null without one. */
      readonly link: unknown;
      /** A server for training: it opens virtual controllers and reaches no real robot. */
      readonly training: boolean;
    };
  };
  /** Signs in by name and password; the session is a cookie */
  readonly signIn: {
    readonly method: "POST";
    readonly path: "/api/v1/session";
    readonly body: {
      readonly name: string;
      readonly password: string;
    };
    readonly answer: {
      /** Whether people sign in by name here. */
      readonly accounts: boolean;
      /** Who is signed in. */
      readonly name: unknown;
      readonly role: "viewer" | "programmer" | "operator" | "admin" | null;
      /** Another role for single robots and cells, by id or name. */
      readonly rights: Readonly<Record<string, "viewer" | "programmer" | "operator" | "admin">>;
      readonly passkeys: number;
      /** Name of the cell that a read-only link lets in to; null without one. */
      readonly link: unknown;
      /** A server for training: it opens virtual controllers and reaches no real robot. */
      readonly training: boolean;
    };
  };
  /** Signs out */
  readonly signOut: {
    readonly method: "DELETE";
    readonly path: "/api/v1/session";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Chooses name and password with a link that works once, and signs in */
  readonly acceptInvitation: {
    readonly method: "POST";
    readonly path: "/api/v1/invitation";
    readonly body: {
      /** What the link carries. */
      readonly link: string;
      /** Asked for when the link is for nobody in particular. */
      readonly name?: string;
      readonly password: string;
    };
    readonly answer: {
      /** Whether people sign in by name here. */
      readonly accounts: boolean;
      /** Who is signed in. */
      readonly name: unknown;
      readonly role: "viewer" | "programmer" | "operator" | "admin" | null;
      /** Another role for single robots and cells, by id or name. */
      readonly rights: Readonly<Record<string, "viewer" | "programmer" | "operator" | "admin">>;
      readonly passkeys: number;
      /** Name of the cell that a read-only link lets in to; null without one. */
      readonly link: unknown;
      /** A server for training: it opens virtual controllers and reaches no real robot. */
      readonly training: boolean;
    };
  };
  /** What a browser needs to sign in by passkey (WebAuthn) */
  readonly beginPasskeySignIn: {
    readonly method: "POST";
    readonly path: "/api/v1/session/passkey/begin";
    readonly body: undefined;
    readonly answer: {
      readonly challenge: string;
      readonly [more: string]: unknown;
    };
  };
  /** Signs in by passkey */
  readonly passkeySignIn: {
    readonly method: "POST";
    readonly path: "/api/v1/session/passkey";
    readonly body: {
      readonly id: string;
      readonly response: Readonly<Record<string, unknown>>;
      readonly [more: string]: unknown;
    };
    readonly answer: {
      /** Whether people sign in by name here. */
      readonly accounts: boolean;
      /** Who is signed in. */
      readonly name: unknown;
      readonly role: "viewer" | "programmer" | "operator" | "admin" | null;
      /** Another role for single robots and cells, by id or name. */
      readonly rights: Readonly<Record<string, "viewer" | "programmer" | "operator" | "admin">>;
      readonly passkeys: number;
      /** Name of the cell that a read-only link lets in to; null without one. */
      readonly link: unknown;
      /** A server for training: it opens virtual controllers and reaches no real robot. */
      readonly training: boolean;
    };
  };
  /** What a browser needs to make a passkey for whoever is signed in */
  readonly beginPasskey: {
    readonly method: "POST";
    readonly path: "/api/v1/passkeys/begin";
    readonly body: undefined;
    readonly answer: {
      readonly challenge: string;
      readonly [more: string]: unknown;
    };
  };
  /** Adds a passkey to whoever is signed in */
  readonly addPasskey: {
    readonly method: "POST";
    readonly path: "/api/v1/passkeys";
    readonly body: {
      readonly id: string;
      readonly response: Readonly<Record<string, unknown>>;
      readonly [more: string]: unknown;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** People with their roles */
  readonly listPeople: {
    readonly method: "GET";
    readonly path: "/api/v1/people";
    readonly body: undefined;
    readonly answer: {
      readonly people: readonly {
        readonly name: string;
        readonly role: "viewer" | "programmer" | "operator" | "admin";
        /** Another role for single robots and cells, by id or name. */
        readonly rights: Readonly<Record<string, "viewer" | "programmer" | "operator" | "admin">>;
        readonly password: boolean;
        readonly passkeys: number;
        readonly invited: boolean;
      }[];
    };
  };
  /**
   * Gives somebody a role, and roles for single robots and cells; a new one or `renew` gives a
   * link to choose a password
   */
  readonly putPerson: {
    readonly method: "PUT";
    readonly path: "/api/v1/people/{name}";
    readonly body: {
      readonly role: "viewer" | "programmer" | "operator" | "admin";
      /** Another role for single robots and cells, by id or name. */
      readonly rights?: Readonly<Record<string, "viewer" | "programmer" | "operator" | "admin">>;
      /** true: a new link to choose a password; the old password ends. */
      readonly renew?: boolean;
    };
    readonly answer: {
      readonly kind: "done";
      readonly link: unknown;
    };
  };
  /** Takes somebody's account away; their sessions and sockets end */
  readonly deletePerson: {
    readonly method: "DELETE";
    readonly path: "/api/v1/people/{name}";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Robot models of the library */
  readonly models: {
    readonly method: "GET";
    readonly path: "/api/v1/models";
    readonly body: undefined;
    readonly answer: {
      readonly models: readonly {
        readonly id: string;
        readonly name: string;
        readonly vendor: string;
        readonly joints: readonly {
          readonly name: string;
          readonly slides: boolean;
          readonly lower_rad: number;
          readonly upper_rad: number;
          readonly speed_rad_s: number;
        }[];
        readonly home_rad: readonly number[];
        /** null where no source states it */
        readonly payload_kg: unknown;
        readonly reach_m: number;
      }[];
    };
  };
  /** Drivers of controllers */
  readonly drivers: {
    readonly method: "GET";
    readonly path: "/api/v1/drivers";
    readonly body: undefined;
    readonly answer: {
      readonly drivers: readonly {
        readonly id: string;
        readonly name: string;
        readonly vendor: string;
        readonly dialect: string;
        readonly ports: Readonly<Record<string, number>>;
      }[];
    };
  };
  /** Languages that programs are written in */
  readonly languages: {
    readonly method: "GET";
    readonly path: "/api/v1/languages";
    readonly body: undefined;
    readonly answer: {
      readonly languages: readonly {
        readonly id: string;
        readonly name: string;
        readonly vendor: string;
      }[];
    };
  };
  /** Open robots */
  readonly listRobots: {
    readonly method: "GET";
    readonly path: "/api/v1/robots";
    readonly body: undefined;
    readonly answer: {
      readonly robots: readonly {
        readonly id: string;
        readonly name: string;
        readonly driver: string;
        readonly model: string;
        readonly virtual: boolean;
        /** What stops the robot when nobody commands it any more. */
        readonly watchdog: string;
      }[];
    };
  };
  /** Opens a robot: a virtual controller, or a driver to one at an address */
  readonly openRobot: {
    readonly method: "POST";
    readonly path: "/api/v1/robots";
    readonly body: {
      readonly id: string;
      /** Id of a driver: GET /api/v1/drivers. */
      readonly driver: string;
      /** Id of a robot model: GET /api/v1/models. */
      readonly model: string;
      readonly name?: string;
      readonly worldFromBase?: {
        readonly position: readonly [number, number, number];
        readonly quaternion: readonly [number, number, number, number];
      };
      /** Where the controller is; left out, a virtual controller is started beside the server. */
      readonly address?: {
        readonly host: string;
        readonly ports?: Readonly<Record<string, number>>;
        readonly data?: Readonly<Record<string, readonly number[]>>;
      };
      /** A saved cell: docs/cell.schema.json. */
      readonly cell?: unknown;
      /** true: opened to watch, nothing can be commanded. */
      readonly watch?: boolean;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Closes it; stops it first */
  readonly closeRobot: {
    readonly method: "DELETE";
    readonly path: "/api/v1/robots/{id}";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Last sample, link and guard; no lease, no sign of life */
  readonly robotState: {
    readonly method: "GET";
    readonly path: "/api/v1/robots/{id}/state";
    readonly body: undefined;
    readonly answer: {
      readonly robot: {
        readonly id: string;
        readonly name: string;
        readonly driver: string;
        readonly model: string;
        readonly virtual: boolean;
        /** What stops the robot when nobody commands it any more. */
        readonly watchdog: string;
      };
      readonly sample: {
        readonly type: "sample";
        readonly station: string;
        readonly sequence: number;
        readonly time_s: number;
        readonly sent_s: number;
        readonly q_rad: readonly number[];
        readonly moving: boolean;
        readonly mode: "manual" | "automatic" | "remote";
        readonly safety: "normal" | "guard-stop" | "protective-stop" | "emergency-stop";
        readonly override: number;
        readonly gripperClosed: boolean;
        readonly step: string;
        readonly message: string;
        readonly signals?: Readonly<Record<string, unknown>>;
        readonly plan_rad: unknown;
        readonly command_rad: unknown;
      } | null;
      readonly link: {
        readonly type: "link";
        readonly station: string;
        readonly state: "closed" | "connecting" | "open" | "lost";
        readonly sentence: string;
        readonly attempts: number;
        readonly rate_Hz: number;
        readonly late_s: number;
        readonly roundTrip_s: unknown;
        readonly missing: number;
      } | null;
      readonly guard: {
        readonly type: "guard";
        readonly station: string;
        readonly holder: string | null;
        readonly pressed: boolean;
        readonly link: "up" | "lost" | "unconfirmed";
        readonly motion: "at-rest" | "moving" | "stopping" | "returning";
        readonly trip: "none" | "return-due" | "return-wanted";
        readonly emergency: boolean;
        readonly watching: boolean;
        readonly cell?: boolean;
        readonly kept_m?: number;
      } | null;
      readonly production: {
        readonly type: "production";
        readonly station: string;
        readonly state: "running" | "held" | "ended";
        readonly cycle: number;
        readonly of: number | null;
        readonly program: string;
        readonly step: string;
        readonly next: string | null;
      } | null;
    };
  };
  /** Robots of all servers of the cluster, or of this one when it is by itself */
  readonly fleet: {
    readonly method: "GET";
    readonly path: "/api/v1/fleet";
    readonly body: undefined;
    readonly answer: {
      readonly robots: readonly {
        readonly site: string;
        readonly id: string;
        readonly name: string;
        readonly model: string;
        readonly vendor: string;
        readonly virtual: boolean;
        readonly state: "running" | "idle" | "attention" | "stopped" | "no-link";
        readonly news: string;
        readonly holder: unknown;
        /** Share of the time since its server was started in which it moved, 0 … 1. */
        readonly use: number;
        /** The same for each ten minutes of the last eight hours, the newest last. */
        readonly use_line: readonly number[];
        /** Since when it has been in this state, milliseconds since 1970; 0 where unknown. */
        readonly since_ms: number;
        /** Where its server is reached from other machines; empty where it is not. */
        readonly url: string;
        readonly roundTrip_s: unknown;
        /** When its last sample came, milliseconds since 1970. */
        readonly heard_ms: number;
      }[];
    };
  };
  /** Asks the server that has a robot to do something, once for each id */
  readonly fleetCommand: {
    readonly method: "POST";
    readonly path: "/api/v1/fleet/{site}/command";
    readonly body: {
      /** Makes it one command, however often it is sent. */
      readonly id: string;
      /** Of `twincell token add` at the server that has the robot. */
      readonly token: string;
      readonly robot: string;
      readonly act:
        | {
            readonly type: "stop";
            readonly emergency: boolean;
          }
        | {
            readonly type: "move";
            readonly q_rad: readonly number[];
          }
        | {
            readonly type: "run";
            /** A program: docs/program.schema.json. */
            readonly program: unknown;
          };
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Takes the lease: one commands, anyone may stop */
  readonly takeLease: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/lease";
    readonly body: {
      /** Name that others see as the one who commands. */
      readonly who?: string;
      /** Without a request that names it the lease ends then. */
      readonly expires_s?: number;
    };
    readonly answer: {
      /** Secret; goes into the header Twincell-Lease. */
      readonly lease: string;
      readonly robot: string;
      readonly who: string;
      readonly expires_s: number;
    };
  };
  /** Gives the lease back; a robot that moves is stopped */
  readonly giveLease: {
    readonly method: "DELETE";
    readonly path: "/api/v1/robots/{id}/lease";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Connects its controller */
  readonly connect: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/connect";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Disconnects it; stops it first */
  readonly disconnect: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/disconnect";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** A person's word that motion is wanted again after a lost link */
  readonly confirm: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/confirm";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Resets the controller after a fault */
  readonly reset: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/reset";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Sets the override */
  readonly speed: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/speed";
    readonly body: {
      readonly percent: number;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Moves to joint angles; answered when it stands. Ending the request stops the robot */
  readonly move: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/move";
    readonly body: {
      /** Target of each joint [rad]; metres for a sliding one. */
      readonly q_rad: readonly number[];
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Checks a program and runs it; answered at its end. Ending the request stops the robot */
  readonly run: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/run";
    readonly body: {
      /** A program: docs/program.schema.json. */
      readonly program: unknown;
      /** true: as a program of the controller's own language. */
      readonly asText?: boolean;
      /**
       * Codes of red findings that you have seen and send it in spite of; any other keeps it from
       * being sent.
       */
      readonly despite?: readonly string[];
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Runs a program cycle after cycle; answered at its end. Ending the request stops the robot */
  readonly produce: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/production";
    readonly body: {
      /** A program: docs/program.schema.json. */
      readonly program: unknown;
      /** true: as a program of the controller's own language. */
      readonly asText?: boolean;
      /**
       * Codes of red findings that you have seen and send it in spite of; any other keeps it from
       * being sent.
       */
      readonly despite?: readonly string[];
      /** null: until it is ended. */
      readonly cycles?: number | null;
      /** Ids of steps of the program's own list before which it is held. */
      readonly breakpoints?: readonly string[];
      /** true: held before each step of that list. */
      readonly stepping?: boolean;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Another program from the next cycle on, without a stop; answered when it has taken over */
  readonly replaceProgram: {
    readonly method: "PUT";
    readonly path: "/api/v1/robots/{id}/production/program";
    readonly body: {
      /** A program: docs/program.schema.json. */
      readonly program: unknown;
      /** true: as a program of the controller's own language. */
      readonly asText?: boolean;
      /**
       * Codes of red findings that you have seen and send it in spite of; any other keeps it from
       * being sent.
       */
      readonly despite?: readonly string[];
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Stops the robot and keeps the place, to take over by hand; anyone may */
  readonly holdProduction: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/production/hold";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Hands back to a held production, from where the robot stands */
  readonly resumeProduction: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/production/resume";
    readonly body: {
      /** With the step it was in, from where the robot stands; or with a cycle from its beginning. */
      readonly from?: "step" | "cycle";
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** One step of a held production */
  readonly stepProduction: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/production/step";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Steps before which the production is held */
  readonly setBreakpoints: {
    readonly method: "PUT";
    readonly path: "/api/v1/robots/{id}/production/breakpoints";
    readonly body: {
      readonly steps: readonly string[];
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** The cell that its guard keeps the robot clear of */
  readonly setCell: {
    readonly method: "PUT";
    readonly path: "/api/v1/robots/{id}/cell";
    readonly body: {
      /** A saved cell: docs/cell.schema.json. */
      readonly cell: unknown;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Stops it; anyone may */
  readonly stop: {
    readonly method: "POST";
    readonly path: "/api/v1/robots/{id}/stop";
    readonly body: {
      readonly emergency?: boolean;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Stops every robot; anyone may */
  readonly stopAll: {
    readonly method: "POST";
    readonly path: "/api/v1/stop";
    readonly body: {
      readonly emergency?: boolean;
    };
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Judges a program: reach, limits, speed, torque, branches, collision */
  readonly check: {
    readonly method: "POST";
    readonly path: "/api/v1/check";
    readonly body: {
      /** A program: docs/program.schema.json. */
      readonly program: unknown;
      /** Left out: the robot that the program names. */
      readonly model?: string;
      /** A saved cell: docs/cell.schema.json. */
      readonly cell?: unknown;
      readonly margin_m?: number;
    };
    readonly answer: {
      readonly ok: boolean;
      readonly steps: readonly {
        readonly id: string;
        readonly verdict: string;
        readonly findings: readonly {
          readonly sentence: string;
          readonly [more: string]: unknown;
        }[];
        readonly [more: string]: unknown;
      }[];
      readonly [more: string]: unknown;
    };
  };
  /** The motion of a program over time */
  readonly plan: {
    readonly method: "POST";
    readonly path: "/api/v1/plan";
    readonly body: {
      /** A program: docs/program.schema.json. */
      readonly program: unknown;
      /** Left out: the robot that the program names. */
      readonly model?: string;
      /** A saved cell: docs/cell.schema.json. */
      readonly cell?: unknown;
      readonly period_s?: number;
    };
    readonly answer: {
      readonly kind: "planned" | "stuck";
      readonly duration_s: number;
      readonly time_s: readonly number[];
      readonly q_rad: readonly (readonly number[])[];
      readonly step: readonly string[];
      readonly stuck: {
        readonly step: string;
        readonly sentence: string;
        readonly hint: string;
        readonly [more: string]: unknown;
      } | null;
    };
  };
  /** A program in a controller's own language, executed and compared with the plan first */
  readonly writeText: {
    readonly method: "POST";
    readonly path: "/api/v1/write";
    readonly body: {
      /** A program: docs/program.schema.json. */
      readonly program: unknown;
      /** Left out: the robot that the program names. */
      readonly model?: string;
      /** A saved cell: docs/cell.schema.json. */
      readonly cell?: unknown;
      /** Id of a language: GET /api/v1/languages. */
      readonly language: string;
    };
    readonly answer: {
      readonly files: readonly {
        readonly name: string;
        readonly text: string;
      }[];
      readonly warnings: readonly unknown[];
      readonly proof: readonly {
        readonly file: string;
        readonly worst_m: number;
        readonly worst_rad: number;
      }[];
    };
  };
  /** Names of the programs kept here */
  readonly list_program: {
    readonly method: "GET";
    readonly path: "/api/v1/programs";
    readonly body: undefined;
    readonly answer: {
      readonly names: readonly string[];
    };
  };
  /** One program */
  readonly get_program: {
    readonly method: "GET";
    readonly path: "/api/v1/programs/{name}";
    readonly body: undefined;
    readonly answer: unknown;
  };
  /** Keeps a program under a name */
  readonly put_program: {
    readonly method: "PUT";
    readonly path: "/api/v1/programs/{name}";
    readonly body: unknown;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Removes a program */
  readonly delete_program: {
    readonly method: "DELETE";
    readonly path: "/api/v1/programs/{name}";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Names of the cells kept here */
  readonly list_cell: {
    readonly method: "GET";
    readonly path: "/api/v1/cells";
    readonly body: undefined;
    readonly answer: {
      readonly names: readonly string[];
    };
  };
  /** One cell */
  readonly get_cell: {
    readonly method: "GET";
    readonly path: "/api/v1/cells/{name}";
    readonly body: undefined;
    readonly answer: unknown;
  };
  /** Keeps a cell under a name */
  readonly put_cell: {
    readonly method: "PUT";
    readonly path: "/api/v1/cells/{name}";
    readonly body: unknown;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Removes a cell */
  readonly delete_cell: {
    readonly method: "DELETE";
    readonly path: "/api/v1/cells/{name}";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** A link by which people look at a cell while it is edited, without an account, for 30 days */
  readonly linkCell: {
    readonly method: "POST";
    readonly path: "/api/v1/cells/{name}/link";
    readonly body: undefined;
    readonly answer: {
      /** Address that lets people look at this cell as it is edited, and at nothing else. */
      readonly link: string;
      /** ISO 8601, UTC: when it ends. */
      readonly until: string;
    };
  };
  /** Takes back all read-only links of a cell */
  readonly unlinkCell: {
    readonly method: "DELETE";
    readonly path: "/api/v1/cells/{name}/link";
    readonly body: undefined;
    readonly answer:
      | {
          readonly kind: "done";
        }
      | {
          readonly kind: "refused";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        }
      | {
          readonly kind: "stopped";
          readonly why: {
            readonly code: string;
            readonly sentence: string;
            readonly hint: string;
            readonly joint?: number;
            readonly value?: number;
            readonly limit?: number;
          };
        };
  };
  /** Recordings of the robots of this server */
  readonly listRecordings: {
    readonly method: "GET";
    readonly path: "/api/v1/recordings";
    readonly body: undefined;
    readonly answer: {
      readonly recordings: readonly {
        readonly robot: string;
        readonly file: string;
        readonly bytes: number;
      }[];
    };
  };
  /** One recording as MCAP */
  readonly getRecording: {
    readonly method: "GET";
    readonly path: "/api/v1/recordings/{robot}/{file}";
    readonly body: undefined;
    readonly answer: Uint8Array;
  };
}
export type RouteId = keyof Routes;
export type Body<Id extends RouteId> = Routes[Id]["body"];
export type Answer<Id extends RouteId> = Routes[Id]["answer"];

export const ROUTES: { readonly [Id in RouteId]: readonly [Routes[Id]["method"], Routes[Id]["path"]] } = {
  apiPage: ["GET", "/api"],
  openapi: ["GET", "/api/openapi.json"],
  asyncapi: ["GET", "/api/asyncapi.json"],
  healthz: ["GET", "/healthz"],
  readyz: ["GET", "/readyz"],
  metrics: ["GET", "/metrics"],
  about: ["GET", "/api/v1"],
  session: ["GET", "/api/v1/session"],
  signIn: ["POST", "/api/v1/session"],
  signOut: ["DELETE", "/api/v1/session"],
  acceptInvitation: ["POST", "/api/v1/invitation"],
  beginPasskeySignIn: ["POST", "/api/v1/session/passkey/begin"],
  passkeySignIn: ["POST", "/api/v1/session/passkey"],
  beginPasskey: ["POST", "/api/v1/passkeys/begin"],
  addPasskey: ["POST", "/api/v1/passkeys"],
  listPeople: ["GET", "/api/v1/people"],
  putPerson: ["PUT", "/api/v1/people/{name}"],
  deletePerson: ["DELETE", "/api/v1/people/{name}"],
  models: ["GET", "/api/v1/models"],
  drivers: ["GET", "/api/v1/drivers"],
  languages: ["GET", "/api/v1/languages"],
  listRobots: ["GET", "/api/v1/robots"],
  openRobot: ["POST", "/api/v1/robots"],
  closeRobot: ["DELETE", "/api/v1/robots/{id}"],
  robotState: ["GET", "/api/v1/robots/{id}/state"],
  fleet: ["GET", "/api/v1/fleet"],
  fleetCommand: ["POST", "/api/v1/fleet/{site}/command"],
  takeLease: ["POST", "/api/v1/robots/{id}/lease"],
  giveLease: ["DELETE", "/api/v1/robots/{id}/lease"],
  connect: ["POST", "/api/v1/robots/{id}/connect"],
  disconnect: ["POST", "/api/v1/robots/{id}/disconnect"],
  confirm: ["POST", "/api/v1/robots/{id}/confirm"],
  reset: ["POST", "/api/v1/robots/{id}/reset"],
  speed: ["POST", "/api/v1/robots/{id}/speed"],
  move: ["POST", "/api/v1/robots/{id}/move"],
  run: ["POST", "/api/v1/robots/{id}/run"],
  produce: ["POST", "/api/v1/robots/{id}/production"],
  replaceProgram: ["PUT", "/api/v1/robots/{id}/production/program"],
  holdProduction: ["POST", "/api/v1/robots/{id}/production/hold"],
  resumeProduction: ["POST", "/api/v1/robots/{id}/production/resume"],
  stepProduction: ["POST", "/api/v1/robots/{id}/production/step"],
  setBreakpoints: ["PUT", "/api/v1/robots/{id}/production/breakpoints"],
  setCell: ["PUT", "/api/v1/robots/{id}/cell"],
  stop: ["POST", "/api/v1/robots/{id}/stop"],
  stopAll: ["POST", "/api/v1/stop"],
  check: ["POST", "/api/v1/check"],
  plan: ["POST", "/api/v1/plan"],
  writeText: ["POST", "/api/v1/write"],
  list_program: ["GET", "/api/v1/programs"],
  get_program: ["GET", "/api/v1/programs/{name}"],
  put_program: ["PUT", "/api/v1/programs/{name}"],
  delete_program: ["DELETE", "/api/v1/programs/{name}"],
  list_cell: ["GET", "/api/v1/cells"],
  get_cell: ["GET", "/api/v1/cells/{name}"],
  put_cell: ["PUT", "/api/v1/cells/{name}"],
  delete_cell: ["DELETE", "/api/v1/cells/{name}"],
  linkCell: ["POST", "/api/v1/cells/{name}/link"],
  unlinkCell: ["DELETE", "/api/v1/cells/{name}/link"],
  listRecordings: ["GET", "/api/v1/recordings"],
  getRecording: ["GET", "/api/v1/recordings/{robot}/{file}"],
};

/** What the socket of the states tells. */
export type StreamEvent =
  | {
      readonly type: "hello";
      readonly protocol: number;
      readonly version: string;
      readonly brands: readonly {
        readonly id: string;
        readonly name: string;
        readonly vendor: string;
        readonly dialect: string;
        readonly ports: Readonly<Record<string, number>>;
      }[];
      readonly stations: readonly {
        readonly id: string;
        readonly name: string;
        readonly brand: string;
        readonly robot: string;
        readonly virtual: boolean;
        readonly watchdog: string;
        readonly robotFile?: unknown;
      }[];
    }
  | {
      readonly type: "opened";
      readonly id: string;
      readonly name: string;
      readonly brand: string;
      readonly robot: string;
      readonly virtual: boolean;
      readonly watchdog: string;
      readonly robotFile?: unknown;
    }
  | {
      readonly type: "closed";
      readonly station: string;
    }
  | {
      readonly type: "sample";
      readonly station: string;
      readonly sequence: number;
      readonly time_s: number;
      readonly sent_s: number;
      readonly q_rad: readonly number[];
      readonly moving: boolean;
      readonly mode: "manual" | "automatic" | "remote";
      readonly safety: "normal" | "guard-stop" | "protective-stop" | "emergency-stop";
      readonly override: number;
      readonly gripperClosed: boolean;
      readonly step: string;
      readonly message: string;
      readonly signals?: Readonly<Record<string, unknown>>;
      readonly plan_rad: unknown;
      readonly command_rad: unknown;
    }
  | {
      readonly type: "link";
      readonly station: string;
      readonly state: "closed" | "connecting" | "open" | "lost";
      readonly sentence: string;
      readonly attempts: number;
      readonly rate_Hz: number;
      readonly late_s: number;
      readonly roundTrip_s: unknown;
      readonly missing: number;
    }
  | {
      readonly type: "guard";
      readonly station: string;
      readonly holder: string | null;
      readonly pressed: boolean;
      readonly link: "up" | "lost" | "unconfirmed";
      readonly motion: "at-rest" | "moving" | "stopping" | "returning";
      readonly trip: "none" | "return-due" | "return-wanted";
      readonly emergency: boolean;
      readonly watching: boolean;
      readonly cell?: boolean;
      readonly kept_m?: number;
    }
  | {
      readonly type: "ahead";
      readonly station: string;
      readonly ahead: {
        readonly q_rad: readonly number[];
        readonly in_s: number;
        readonly problem: {
          readonly code: string;
          readonly sentence: string;
          readonly in_s: number;
        } | null;
      } | null;
    }
  | {
      readonly type: "began";
      readonly stations: readonly string[];
      readonly spread_s: number;
    }
  | {
      readonly type: "ended";
      readonly stations: readonly {
        readonly station: string;
        readonly outcome:
          | {
              readonly kind: "done";
            }
          | {
              readonly kind: "refused";
              readonly why: {
                readonly code: string;
                readonly sentence: string;
                readonly hint: string;
                readonly joint?: number;
                readonly value?: number;
                readonly limit?: number;
              };
            }
          | {
              readonly kind: "stopped";
              readonly why: {
                readonly code: string;
                readonly sentence: string;
                readonly hint: string;
                readonly joint?: number;
                readonly value?: number;
                readonly limit?: number;
              };
            };
      }[];
    }
  | {
      readonly type: "act";
      readonly station: string;
      readonly number: number;
      readonly who: string;
      readonly action: string;
      readonly detail: string;
      readonly command: boolean;
      readonly target: readonly number[];
      readonly outcome:
        | {
            readonly kind: "done";
          }
        | {
            readonly kind: "refused";
            readonly why: {
              readonly code: string;
              readonly sentence: string;
              readonly hint: string;
              readonly joint?: number;
              readonly value?: number;
              readonly limit?: number;
            };
          }
        | {
            readonly kind: "stopped";
            readonly why: {
              readonly code: string;
              readonly sentence: string;
              readonly hint: string;
              readonly joint?: number;
              readonly value?: number;
              readonly limit?: number;
            };
          }
        | null;
    }
  | {
      readonly type: "notice";
      readonly station: string;
      readonly why: {
        readonly code: string;
        readonly sentence: string;
        readonly hint: string;
        readonly joint?: number;
        readonly value?: number;
        readonly limit?: number;
      };
    }
  | {
      readonly type: "production";
      readonly station: string;
      readonly state: "running" | "held" | "ended";
      readonly cycle: number;
      readonly of: number | null;
      readonly program: string;
      readonly step: string;
      readonly next: string | null;
    }
  | {
      readonly type: "fault";
      readonly sentence: string;
    };
export type StreamEventOf<Type extends StreamEvent["type"]> = Extract<StreamEvent, { readonly type: Type }>;
