/** What a user has to know: which file, what was found, what is accepted. */
export class Problem extends Error {
  constructor(file, found) {
    super(`${file}: ${found}`);
  }
}
