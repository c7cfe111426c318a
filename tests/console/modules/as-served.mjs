/** Lets Node find modules of drivers' page as browsers do, who see the console's files beside it. */

const CONSOLE = new URL('../../../app/console/static/', import.meta.url);

/** Return where a module is: `../../console/` is a folder of the service, not of the files. */
export function resolve(specifier, context, next) {
  const [, shared] = /^\.\.\/\.\.\/console\/(.+)$/.exec(specifier) ?? [];
  return next(shared ? new URL(shared, CONSOLE).href : specifier, context);
}
