// SPDX-License-Identifier: BSD-3-Clause

/** Which scan is looked at; tables, plots and the map follow each other by it. */
export class Selection {
  scan = null;
  #followers = [];

  follow(follower) {
    this.#followers.push(follower);
  }

  /** \param source who chose; it need not scroll to what the reader just touched */
  choose(scan, source) {
    this.scan = scan === this.scan ? null : scan;
    for (const follower of this.#followers) follower(this.scan, source);
  }
}
