/** What the service is, and how the page shows all. */

import { language } from '../texts.js';

export const SERVICE = {
  schemas: null, // of /openapi.json
  examples: [], // {name, request, isFirst}
  config: {
    policies: [], tile_url: null, tile_attribution: '', streets: [], max_job_seconds: Infinity,
  },
  starting: null, // {detail} until the service is ready
  dark: false,
  language: language(), // of the texts
};
