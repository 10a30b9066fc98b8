// SPDX-License-Identifier: BSD-3-Clause
// Boxes that scroll sideways can be reached by the keyboard.
addEventListener('load', () => {
  const mark = () => document.querySelectorAll('pre, .table-wrapper').forEach((box) => {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else box.removeAttribute('tabindex');
  });
  mark();
  addEventListener('resize', mark);
  addEventListener('change', mark); // another language is shown
});
