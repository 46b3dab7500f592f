// Starts the page.

// Light or dark: what the system says until the button is pressed.
function addThemeButton(redraw) {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  const isDark = () => (root.dataset.theme ?? (dark.matches ? "dark" : "light")) === "dark";
  const refresh = () => {
    find("theme").textContent = isDark() ? "Light" : "Dark";
    find("theme").setAttribute("aria-label", isDark() ? "Switch to light colours" : "Switch to dark colours");
    redraw();
  };
  find("theme").hidden = false;
  find("theme").addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    refresh();
  });
  dark.addEventListener("change", refresh);
  refresh();
}

async function start() {
  if (!("DecompressionStream" in window)) {
    find("explore-missing").textContent = "The pictures need a newer browser.";
    return;
  }
  const explorer = new Explorer();
  find("explore").hidden = false;
  await explorer.start();
  find("explore-missing").hidden = true;
  const chart = new Chart(find("chart"), find("chart-reading"));
  const hasChart = data.partitions[0].layers[0] > 0;
  find("silence").hidden = !hasChart;
  explorer.onChange = () => hasChart && chart.show(explorer.partition());
  explorer.onChange();
  const redraw = () => {
    explorer.mark();
    if (hasChart) chart.draw();
  };
  addThemeButton(redraw);
  new ResizeObserver(redraw).observe(find("explore"));
  document.documentElement.dataset.ready = "yes";
}

start();
