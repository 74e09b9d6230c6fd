// A browser loads no module of a page that was opened as a file: this plain script alone can say so.
if (location.protocol === "file:") {
  const place = document.getElementById("message");
  const code = document.createElement("p");
  code.className = "code";
  code.textContent = "PAGE_FILE";
  place.replaceChildren(
    code,
    "This page was opened as a file, and browsers load no modules from there. ",
    "Open it with groma view SCAN, or through any server of files.",
  );
  // Nothing else on the page would answer.
  document.body.replaceChildren(place);
}
