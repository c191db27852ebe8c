export const LINES = {
    motion: /^\s*(?:Move|Search|Trigg[JLC]|Arc[LC]|Spot[LJ]|Paint|Disp[LC])[A-Za-z]*\b/i,
    opens: /^\s*(?:IF\b.*\bTHEN|WHILE\b|FOR\b|TEST\b)/i,
    parts: /^\s*(?:ELSEIF|ELSE|CASE|DEFAULT)\b/i,
    closes: /^\s*(?:ENDIF|ENDWHILE|ENDFOR|ENDTEST)\b/i,
    keeps: /^\s*(?:MODULE|ENDMODULE|(?:LOCAL\s+)?(?:PROC|FUNC|TRAP)|ENDPROC|ENDFUNC|ENDTRAP)\b/i,
};
