/** Plans kept by name on the service. */

import { deleteKeptPlan, getKeptPlan, getKeptPlans, putKeptPlan, renameKeptPlan } from '../api.js';

export const list = getKeptPlans;
export const read = getKeptPlan;
export const write = putKeptPlan;
export const rename = renameKeptPlan;
export const remove = deleteKeptPlan;
