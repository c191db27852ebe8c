import { addCatalogue } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";

// Imported by every worker that is told the id of a robot: a worker shares nothing with the page.
addCatalogue(CATALOGUE);
